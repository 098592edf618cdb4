#include "methods/modes/tetgen_process.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tetgen.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <thread>

#include "core/error.h"

namespace fracbench::modes {
namespace {

constexpr int kUnknownCode = 99;

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

void fill_input(const TriangleMesh& surface, tetgenio& input) {
  input.firstnumber = 0;
  input.numberofpoints = static_cast<int>(surface.vertices.size());
  input.pointlist = new REAL[3 * surface.vertices.size()];
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    for (int k = 0; k < 3; ++k) input.pointlist[3 * i + k] = surface.vertices[i][k];
  }
  input.numberoffacets = static_cast<int>(surface.faces.size());
  input.facetlist = new tetgenio::facet[surface.faces.size()];
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    tetgenio::facet& facet = input.facetlist[f];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::init(facet.polygonlist);
    facet.polygonlist[0].numberofvertices = 3;
    facet.polygonlist[0].vertexlist = new int[3];
    for (int k = 0; k < 3; ++k) facet.polygonlist[0].vertexlist[k] = surface.faces[f][k];
  }
}

/// Ends the process with TetGen's code.
[[noreturn]] void exit_with_code() {
  int code = kUnknownCode;
  try {
    std::rethrow_exception(std::current_exception());
  } catch (const int thrown) {
    code = thrown;
  } catch (...) {
  }
  std::fflush(stdout);
  _exit(code);
}

template <typename T>
void put(std::FILE* file, const T* values, std::size_t count) {
  if (std::fwrite(values, sizeof(T), count, file) != count) _exit(1);
}

template <typename T>
bool get(std::FILE* file, T* values, std::size_t count) {
  return std::fread(values, sizeof(T), count, file) == count;
}

[[noreturn]] void be_the_child(const TriangleMesh& surface, const std::string& switches,
                               std::FILE* result, std::FILE* messages) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  std::signal(SIGSEGV, SIG_DFL);
  dup2(fileno(messages), STDOUT_FILENO);
  dup2(fileno(messages), STDERR_FILENO);
  std::set_terminate(exit_with_code);
  tetgenio input, output;
  fill_input(surface, input);
  // An exception that no function of its thread waits for ends the process before anything is
  // destroyed, and it is TetGen's destructor that crashes.
  std::string changeable = switches;
  std::thread([&] { tetrahedralize(changeable.data(), &input, &output); }).join();
  std::fflush(stdout);

  const int counts[] = {output.numberofpoints, output.numberoftetrahedra,
                        output.numberoftetrahedronattributes};
  put(result, counts, 3);
  put(result, output.pointlist, 3 * static_cast<std::size_t>(counts[0]));
  for (int t = 0; t < counts[1]; ++t) {
    put(result, output.tetrahedronlist + output.numberofcorners * t, 4);
  }
  for (int t = 0; t < counts[1]; ++t) {
    const double region = counts[2] > 0 ? output.tetrahedronattributelist[counts[2] * t] : 0;
    put(result, &region, 1);
  }
  std::fflush(result);
  _exit(0);
}

std::string text_of(std::FILE* file) {
  std::string text;
  char part[4096];
  std::rewind(file);
  for (std::size_t n; (n = std::fread(part, 1, sizeof part, file)) > 0;) text.append(part, n);
  return text;
}

bool read_result(std::FILE* file, TetgenOutput& output) {
  std::rewind(file);
  int counts[3];
  if (!get(file, counts, 3)) return false;
  output.vertices.resize(counts[0]);
  output.tets.resize(counts[1]);
  output.regions.resize(counts[1]);
  static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Tet) == 4 * sizeof(int));
  return get(file, reinterpret_cast<double*>(output.vertices.data()), 3 * output.vertices.size()) &&
         get(file, reinterpret_cast<int*>(output.tets.data()), 4 * output.tets.size()) &&
         get(file, output.regions.data(), output.regions.size());
}

}  // namespace

TetgenOutput run_tetgen(const TriangleMesh& surface, const std::string& switches) {
  const File result(std::tmpfile(), std::fclose), messages(std::tmpfile(), std::fclose);
  const auto fail = [](const char* what) {
    throw MethodFailure(std::string("TetGen could not be started: ") + what + ": " +
                        std::strerror(errno));
  };
  if (!result || !messages) fail("temporary file");
  std::fflush(nullptr);  // or the child prints what is still in our buffers a second time
  const pid_t child = fork();
  if (child < 0) fail("fork");
  if (child == 0) be_the_child(surface, switches, result.get(), messages.get());
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) fail("waitpid");
  }
  TetgenOutput output;
  output.messages = text_of(messages.get());
  output.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (output.code == 0 && !read_result(result.get(), output)) output.code = -1;
  return output;
}

}  // namespace fracbench::modes
