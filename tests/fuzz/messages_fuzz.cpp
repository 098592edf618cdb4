// What a worker process may say to its supervisor: a stream of messages, with records in them.

#include "harness/data_tree.h"
#include "harness/record.h"
#include "harness/workers/message.h"
#include "harness/workers/tree_bytes.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fracbench;
  MessageReader reader;
  try {
    reader.add(fuzz::text_of(data, size));
    while (const auto message = reader.next()) {
      if (message->kind == MessageKind::record) to_record(tree_from_bytes(message->body));
    }
  } catch (const DataError&) {
  }
  // The tree by itself, without the message that it comes in.
  try {
    const DataTree tree = tree_from_bytes(fuzz::text_of(data, size));
    if (tree_from_bytes(to_bytes(tree)) != tree) __builtin_trap();
    to_record(tree);
  } catch (const DataError&) {
  }
  return 0;
}
