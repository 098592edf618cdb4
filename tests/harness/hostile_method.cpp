#include "hostile_method.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "harness/suite_reader.h"
#include "toy_catalog.h"

namespace fracbench {

namespace {

constexpr std::size_t kMebi = 1 << 20;

[[noreturn]] void hang() {
  while (true) std::this_thread::sleep_for(std::chrono::seconds(1));
}

[[noreturn]] void spin() {
  volatile unsigned count = 0;
  while (true) {
    const unsigned next = count + 1;
    count = next;
  }
}

/// The compiler must not see that there is nothing, or it makes something else of it.
__attribute__((no_sanitize("undefined"))) void follow_null() {
  volatile std::uintptr_t nowhere = 0;
  *reinterpret_cast<volatile int*>(nowhere) = 1;
}

/// Far beyond any stack, though not for ever, which a compiler may take to be a mistake.
int overflow_stack(int depth) {
  volatile char here[4096];
  here[depth % 4096] = 1;
  return depth == 0 ? 0 : overflow_stack(depth - 1) + here[depth % 4096];
}

void allocate_without_end() {
  std::vector<std::unique_ptr<char[]>> all;
  while (true) {
    all.push_back(std::make_unique<char[]>(8 * kMebi));
    std::memset(all.back().get(), 1, 8 * kMebi);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// More than there can be, at once.
void allocate_at_once() {
  std::vector<double> huge(std::size_t{1} << 43);
  huge.back() = 1;
}

void throw_in_a_thread() {
  std::thread([] { throw std::bad_alloc(); }).join();
}

void print(std::size_t bytes) {
  const std::string line = "all work and no play makes a dull method\n";
  for (std::size_t k = 0; k < bytes; k += line.size()) {
    std::fputs(line.c_str(), k % 2 == 0 ? stdout : stderr);
  }
  std::fflush(stdout);
}

/// A child that lives until it is killed.
void leave_a_child(const std::string& file, bool in_a_group_of_its_own, std::size_t memory = 0) {
  const ::pid_t child = ::fork();
  if (child != 0) {
    std::ofstream(file, std::ios::app) << child << "\n";
    return;
  }
  if (in_a_group_of_its_own) ::setsid();
  std::signal(SIGTERM, SIG_IGN);
  std::vector<char> taken(memory, 1);
  hang();
}

void say(std::string_view bytes) {
  if (::write(3, bytes.data(), bytes.size()) < 0) std::abort();
}

/// What a record's message begins with, and a length that no machine has.
void claim_a_huge_answer() {
  const std::uint32_t kind = 5;
  const std::uint64_t length = std::uint64_t{1} << 62;
  std::string header(12, '\0');
  std::memcpy(header.data(), &kind, 4);
  std::memcpy(header.data() + 4, &length, 8);
  say(header);
  hang();
}

/// Progress without a name and without end.
void babble() {
  std::string message(20, '\0');
  message[0] = 4;
  message[4] = 8;
  while (true) say(message);
}

const std::map<std::string, std::function<void(const std::string& file)>>& attacks() {
  using File = const std::string&;
  static const std::map<std::string, std::function<void(File)>> all = {
      {"none", [](File) {}},
      {"hang", [](File) { hang(); }},
      {"spin", [](File) { spin(); }},
      {"stop", [](File) { std::raise(SIGSTOP); }},
      {"segfault", [](File) { follow_null(); }},
      {"stack", [](File) { overflow_stack(1 << 24); }},
      {"abort", [](File) { std::abort(); }},
      {"kill", [](File) { std::raise(SIGKILL); }},
      {"exit", [](File) { std::_Exit(0); }},
      {"exit-17", [](File) { std::exit(17); }},
      {"throw", [](File) { throw std::logic_error("a mistake"); }},
      {"terminate", [](File) { std::terminate(); }},
      {"thread", [](File) { throw_in_a_thread(); }},
      {"allocate", [](File) { allocate_without_end(); }},
      {"allocate-at-once", [](File) { allocate_at_once(); }},
      {"print-for-ever",
       [](File) {
         while (true) print(kMebi);
       }},
      {"print-and-answer", [](File) { print(30 * kMebi); }},
      {"print-and-abort",
       [](File) {
         std::fputs("first\nsecond\n\xff\x01 third \xc3\xa4\n", stderr);
         std::abort();
       }},
      {"children",
       [](File file) {
         for (int k = 0; k < 5; ++k) leave_a_child(file, false);
         hang();
       }},
      {"children-and-crash",
       [](File file) {
         for (int k = 0; k < 5; ++k) leave_a_child(file, false);
         std::abort();
       }},
      {"children-elsewhere",
       [](File file) {
         for (int k = 0; k < 2; ++k) leave_a_child(file, true);
         hang();
       }},
      {"children-eat",
       [](File file) {
         for (int k = 0; k < 3; ++k) leave_a_child(file, false, 200 * kMebi);
         hang();
       }},
      {"garbage",
       [](File) {
         say("this is no message, and it goes on for a while");
         hang();
       }},
      {"huge-answer", [](File) { claim_a_huge_answer(); }},
      {"babble", [](File) { babble(); }},
      {"close",
       [](File) {
         ::close(3);
         hang();
       }},
  };
  return all;
}

class HostileBody : public Breakable {
 public:
  HostileBody(std::unique_ptr<Breakable> good, Options options)
      : good_(std::move(good)), options_(std::move(options)) {}

  std::vector<Piece> fracture(const Impact& impact, Context& context) const override {
    const bool now = context.random.fork("attack").uniform() < options_.number("share");
    if (now && !options_.flag("early")) {
      attacks().at(options_.text("attack"))(options_.text("children"));
    }
    return good_->fracture(impact, context);
  }
  void save(const std::filesystem::path&) const override {}

 private:
  std::unique_ptr<Breakable> good_;
  Options options_;
};

class Hostile : public Method {
 public:
  MethodInfo info() const override {
    return {.name = "hostile",
            .summary = "does what no method should",
            .publications = {},
            .shape_type = "planar",
            .random = true,
            .quick_to_prepare = true,
            .source_digest = "1"};
  }
  OptionsSchema options() const override {
    OptionSpec attack{
        .name = "attack", .fallback = std::string("none"), .unit = "", .summary = "what it does"};
    for (const auto& [name, work] : attacks()) attack.choices.push_back(name);
    return {attack,
            {.name = "share", .fallback = 1.0, .unit = "", .summary = "of the impacts"},
            {.name = "early", .fallback = false, .unit = "", .summary = "while it is prepared"},
            {.name = "children",
             .fallback = std::string(),
             .unit = "",
             .summary = "a file of the processes that it leaves, or that prepare it"}};
  }
  std::unique_ptr<Breakable> prepare(const Target& target, const LearningData& learning,
                                     const Options& options, Context& context) const override {
    if (options.flag("early")) {
      std::ofstream(options.text("children"), std::ios::app) << ::getpid() << "\n";
      attacks().at(options.text("attack"))(options.text("children"));
    }
    const ToyWorld world;
    const Method& good = world.catalog().method("halves", "hostile");
    return std::make_unique<HostileBody>(
        good.prepare(target, learning, Options(good.options(), {}, "hostile"), context), options);
  }
  std::unique_ptr<Breakable> load(const std::filesystem::path&, const Target&,
                                  const Options&) const override {
    throw std::logic_error("never saved");
  }
};

}  // namespace

std::unique_ptr<Method> make_hostile_method() { return std::make_unique<Hostile>(); }

Suite hostile_suite(const Catalog& catalog) {
  return parse_suite(R"(
seed = 3
shapes = ["box"]
timeout_s = 1
prepare_timeout_s = 5
memory_mb = 400
[[scenario]]
family = "shove"
count = 6
speed = 40
[[method]]
name = "hostile"
[[method]]
name = "halves"
timeout_s = 60
)",
                     "hostile.toml", catalog);
}

}  // namespace fracbench
