#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/breakable.h"
#include "core/target.h"

namespace fracbench::external {

/// What a program is told beside the body and the impact.
struct Request {
  std::uint64_t seed = 0;  ///< below 2^53, so that every reader of JSON understands it
  int threads = 1;
  std::string settings;  ///< the user's own words
};

/// Writes body.obj and request.json into `folder`. The layout is that of docs/add-a-method.md.
void write_request(const std::filesystem::path& folder, const Target& target, const Impact& impact,
                   const Request& request);

/// The fragments in `folder`: every file .obj, .ply, .stl or .off is one, in the order of their
/// names. Where their faces come from is found by their place on the body. Throws MethodFailure for
/// a file that is no mesh, and where there is none.
std::vector<Piece> read_pieces(const std::filesystem::path& folder, const TriangleMesh& body,
                               int threads);

}  // namespace fracbench::external
