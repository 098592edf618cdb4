#include "tests/app/program.h"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace fracbench {

namespace fs = std::filesystem;

namespace {

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

Answer call(const std::string& arguments, const fs::path& folder, const fs::path& cache) {
  const TemporaryFolder streams;
  Answer answer = call_with_output(arguments, folder, streams.path() / "out", cache);
  answer.output = content_of(streams.path() / "out");
  return answer;
}

Answer call_with_output(const std::string& arguments, const fs::path& folder,
                        const fs::path& output, const fs::path& cache) {
  const TemporaryFolder streams;
  const fs::path errors = streams.path() / "err";
  const std::string line = "cd '" + folder.string() + "' && FRACBENCH_CACHE='" + cache.string() +
                           "' exec '" FRACBENCH_PROGRAM "' " + arguments + " >'" + output.string() +
                           "' 2>'" + errors.string() + "' </dev/null";
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), "", content_of(errors)};
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "fracbench-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path TemporaryFolder::write(const std::string& name, const std::string& content) const {
  std::ofstream(path_ / name, std::ios::binary) << content;
  return path_ / name;
}

std::string TemporaryFolder::read(const std::string& name) const {
  return content_of(path_ / name);
}

}  // namespace fracbench
