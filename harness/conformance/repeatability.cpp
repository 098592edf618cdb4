#include "harness/conformance/repeatability.h"

#include "core/digest.h"
#include "core/temporary_folder.h"

namespace fracbench::conformance {

namespace {

std::string digest_of(const std::vector<Piece>& pieces) {
  Digest digest;
  for (const Piece& piece : pieces) {
    digest.add(piece.mesh);
    for (const PieceFace& face : piece.faces) {
      digest.add(static_cast<std::uint64_t>(face.parent_face));
      digest.add(static_cast<std::uint64_t>(face.neighbour));
    }
  }
  return digest.hex();
}

}  // namespace

CheckResult check_same_seed(const Bench& bench) {
  const auto run = [&] { return digest_of(bench.blow(*bench.prepare(), bench.impact(0))); };
  return run() == run() ? passed() : failed("prepared and broken twice: other bytes");
}

CheckResult check_const_use(const Bench& bench) {
  const auto body = bench.prepare();
  const std::string first = digest_of(bench.blow(*body, bench.impact(0)));
  return digest_of(bench.blow(*body, bench.impact(0))) == first
             ? passed()
             : failed("one body broken twice by the same blow: other bytes");
}

CheckResult check_other_impact(const Bench& bench) {
  const auto used = bench.prepare();
  const std::string before = digest_of(bench.blow(*used, bench.impact(0)));
  const std::string after = digest_of(bench.blow(*used, bench.impact(1)));
  const std::string fresh = digest_of(bench.blow(*bench.prepare(), bench.impact(1)));
  if (after != fresh) {
    return failed("what a blow does depends on the blow before" +
                  std::string(after == before ? ": it is that one's answer again" : ""));
  }
  return passed();
}

CheckResult check_other_seed(const Bench& bench) {
  const auto body = bench.prepare();
  const std::string first = digest_of(bench.blow(*body, bench.impact(0)));
  bool differs = false;
  for (std::uint64_t seed = 2; seed < 6; ++seed) {
    differs = differs || digest_of(bench.blow(*body, bench.impact(0), seed)) != first;
  }
  const bool random = bench.subject().method.info().random;
  if (differs == random) return passed(random ? "random" : "not random");
  return failed(random ? "says that it is random, but five seeds give the same bytes"
                       : "does not say that it is random, but another seed gives other bytes");
}

CheckResult check_save_load(const Bench& bench) {
  const auto body = bench.prepare();
  const TemporaryWorkFolder folder("check");
  body->save(folder.path());
  const CheckSubject& subject = bench.subject();
  const auto loaded = subject.method.load(folder.path(), subject.target, subject.options);
  return digest_of(bench.blow(*loaded, bench.impact(0))) ==
                 digest_of(bench.blow(*body, bench.impact(0)))
             ? passed()
             : failed("a body that was saved and loaded breaks into other bytes");
}

}  // namespace fracbench::conformance
