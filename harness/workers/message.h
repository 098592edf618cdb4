#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace fracbench {

/// What the supervisor and a worker say to each other; see docs/architecture.md.
enum class MessageKind : std::uint32_t {
  job = 1,       ///< to the worker: shape, method and options of all cells to come (encode_job)
  cell = 2,      ///< to the worker: measure this (encode_cell)
  phase = 3,     ///< from the worker: a CellPhase as one byte
  progress = 4,  ///< from the worker: eight bytes of fraction, then the name of the work
  record = 5,    ///< from the worker: the record as to_bytes(to_tree(record))
  refusal = 6,   ///< from the worker: the text of an InputError; the run ends
};

struct Message {
  MessageKind kind = MessageKind::job;
  std::string body;
};

/// The bytes of a message: kind (4 bytes) and length of the body (8), both in this machine's order,
/// and the body.
std::string to_bytes(const Message& message);

/// Takes a stream of bytes apart into messages. Keeps no more than what has arrived: a length that
/// is a lie costs nothing.
class MessageReader {
 public:
  void add(std::string_view bytes) { buffer_.append(bytes); }

  /// The next message that is there as a whole. Throws DataError for an unknown kind and for a
  /// length beyond that of any message of this kind.
  std::optional<Message> next();

  /// Whether a part of a message waits for its rest.
  bool in_the_middle() const { return start_ < buffer_.size(); }

 private:
  std::string buffer_;
  std::size_t start_ = 0;  ///< of what was not returned yet
};

}  // namespace fracbench
