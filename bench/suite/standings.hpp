// Submissions of one track beside each other.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/compare/statistics.hpp"
#include "bench/compare/text_table.hpp"
#include "bench/suite/submission.hpp"

namespace gnbv {

/// An entry, and whether it is told apart from the first one: a paired test over structures
/// (Wilcoxon's signed ranks, exact, two-sided), adjusted by Holm for the entries of the table.
struct Standing {
  const Submission* entry = nullptr;  // stays with the caller
  SignedRankTest test = {};           // of how much more the first one has, structure by structure
  double p = 1.0;                     // adjusted
};

/// What a table says of an entry against the first. Scores are means, and ranks may say otherwise.
std::string verdict_of(const Standing& standing, bool is_first);

/// By falling score, then by name. Throws BadInput for two entries of one name, and for one that is
/// not of the suite (need_of_suite).
std::vector<Standing> standings(const Suite& suite, const std::vector<Submission>& entries,
                                const std::string& track);

/// A table a track that has entries.
std::vector<TextTable> standings_tables(const Suite& suite, const std::vector<Submission>& entries);

/// The data of the static page, as JSON; `link` says where a mission of an entry can be seen again,
/// "" where it cannot.
std::string standings_json(
    const Suite& suite, const std::vector<Submission>& entries,
    const std::function<std::string(const Submission&, const std::string& task)>& link);

}  // namespace gnbv
