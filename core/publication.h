#pragma once

#include <span>
#include <string>

namespace fracbench {

/// A paper, as a BibTeX entry has it.
struct Publication {
  std::string key;      ///< such as "hahn2015"
  std::string authors;  ///< given names first, joined by " and "
  std::string title;
  std::string journal;  ///< empty for a preprint, whose `note` says where it is
  std::string volume = {};
  std::string number = {};
  int year = 0;
  std::string doi = {};
  std::string note = {};
};

/// `David Hahn and Chris Wojtan, "Title", Journal 34(4), 2015`; several joined by "; ".
std::string citation(std::span<const Publication> publications);

/// An @article, or @misc where there is no journal. UTF-8, with what means something in LaTeX
/// escaped; capitals of the title are kept.
std::string to_bibtex(const Publication& publication);

}  // namespace fracbench
