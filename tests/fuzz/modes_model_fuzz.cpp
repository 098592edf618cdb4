// The prepared model of the method modes. Its file ends with a check sum of what comes before: the
// input is a file without it, so that what is made of the arrays is reached, too.

#include "core/array_file.h"
#include "core/error.h"
#include "methods/modes/model.h"
#include "scratch_file.h"

namespace {

/// What the model says it is of; its faces are all that a model may point at.
fracbench::Target tetrahedron() {
  return {.name = "tetrahedron",
          .mesh = {.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                   .faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}},
          .material = {}};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fracbench;
  constexpr ArrayFileKind kind{.format = "fracbench modes", .version = 1};
  static const Target target = tetrahedron();
  const std::string_view text = fuzz::text_of(data, size);
  try {
    const auto file = fuzz::scratch().write("model.fracbench", fuzz::with_digest(text));
    ArrayFile arrays = read_array_file(file, kind);
    arrays.texts["body"] = fuzz::digest_of(target.mesh);
    arrays.texts["settings"] = "";
    write_array_file(file, arrays, kind);
    modes::load_model(file.parent_path(), target, "");
  } catch (const InputError&) {
  }
  return 0;
}
