#include "harness/workers/message.h"

#include <fmt/format.h>

#include <cstring>

#include "harness/data_tree.h"

namespace fracbench {

namespace {

constexpr std::size_t kHeader = sizeof(std::uint32_t) + sizeof(std::uint64_t);

/// Bytes of messages that were returned, kept so that not every message moves what follows it.
constexpr std::size_t kReturnedKept = 1 << 20;

/// More than any honest message has. Jobs hold learning data, records trajectories.
std::uint64_t largest(MessageKind kind) {
  switch (kind) {
    case MessageKind::job:
      return std::uint64_t{1} << 36;
    case MessageKind::record:
      return std::uint64_t{1} << 30;
    case MessageKind::cell:
      return std::uint64_t{1} << 24;
    case MessageKind::phase:
    case MessageKind::progress:
    case MessageKind::refusal:
      return std::uint64_t{1} << 16;
  }
  return 0;
}

}  // namespace

std::string to_bytes(const Message& message) {
  const auto kind = static_cast<std::uint32_t>(message.kind);
  const std::uint64_t length = message.body.size();
  std::string bytes(kHeader, '\0');
  std::memcpy(bytes.data(), &kind, sizeof kind);
  std::memcpy(bytes.data() + sizeof kind, &length, sizeof length);
  return bytes + message.body;
}

std::optional<Message> MessageReader::next() {
  if (buffer_.size() - start_ < kHeader) return std::nullopt;
  std::uint32_t kind = 0;
  std::uint64_t length = 0;
  std::memcpy(&kind, buffer_.data() + start_, sizeof kind);
  std::memcpy(&length, buffer_.data() + start_ + sizeof kind, sizeof length);
  Message message{.kind = static_cast<MessageKind>(kind), .body = {}};
  if (largest(message.kind) == 0) throw DataError(fmt::format("unknown message {}", kind));
  if (length > largest(message.kind)) {
    throw DataError(fmt::format("message {} claims to have {} bytes", kind, length));
  }
  if (buffer_.size() - start_ - kHeader < length) return std::nullopt;
  message.body = buffer_.substr(start_ + kHeader, length);
  start_ += kHeader + length;
  if (start_ == buffer_.size()) {
    // A large record leaves no large buffer behind.
    std::string().swap(buffer_);
    start_ = 0;
  } else if (start_ > kReturnedKept) {
    buffer_.erase(0, start_);
    start_ = 0;
  }
  return message;
}

}  // namespace fracbench
