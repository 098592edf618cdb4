#include "harness/kept_lines.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string_view>

#include "core/digest.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kEnding = ".jsonl";
constexpr std::size_t kChecksumDigits = 16;

std::string checksum(std::string_view text) {
  Digest digest;
  digest.add(text);
  return digest.hex().substr(0, kChecksumDigits);
}

/// The text of a line, where it is as it was written.
std::optional<std::string_view> intact_text(std::string_view line) {
  if (line.size() <= kChecksumDigits) return std::nullopt;
  const std::string_view text = line.substr(kChecksumDigits + 1);
  if (checksum(text) != line.substr(0, kChecksumDigits)) return std::nullopt;
  return text;
}

}  // namespace

void KeptLines::read(const std::function<void(const Json&)>& take) const {
  std::error_code none;
  for (const auto& item : fs::directory_iterator(folder_, none)) {
    if (item.path().extension() != kEnding) continue;
    std::ifstream stream(item.path());
    for (std::string line; std::getline(stream, line);) {
      const auto text = intact_text(line);
      if (!text) continue;
      try {
        take(Json::parse(*text));
      } catch (const Json::exception&) {
      } catch (const std::bad_optional_access&) {
      }
    }
  }
}

void KeptLines::append(const std::vector<std::string>& texts) {
  if (texts.empty() || !writable_) return;
  std::string lines;
  for (const std::string& text : texts) lines += checksum(text) + " " + text + "\n";
  std::error_code none;
  fs::create_directory(folder_, none);
  if (file_.empty()) {
    std::random_device device;
    file_ = folder_ / fmt::format("{:08x}{:08x}{}", device(), device(), kEnding);
  }
  const int file = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  writable_ =
      file >= 0 && ::write(file, lines.data(), lines.size()) == static_cast<ssize_t>(lines.size());
  if (file >= 0) ::close(file);
}

}  // namespace fracbench
