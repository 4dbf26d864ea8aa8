/// Finds the known word that a mistyped one most likely stands for, for the end of an error
/// message.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

/// Number of letters to insert, delete, replace or swap with their neighbour to turn `a` into `b`.
/// @see Damerau, A technique for computer detection and correction of spelling errors, 1964;
///      here in its restricted form, which never edits a swapped pair again.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The first of the known words with the smallest distance from `word`. A word that contains
/// `word`, or is contained in it, is taken when no other is close. Empty when none is near.
[[nodiscard]] std::string nearest_word(std::string_view word,
                                       const std::vector<std::string>& known);

/// "; did you mean NEAREST?", or nothing when no known word is near.
[[nodiscard]] std::string did_you_mean(std::string_view word,
                                       const std::vector<std::string>& known);

/// "A, B, C": the words with commas between them.
[[nodiscard]] std::string word_list(const std::vector<std::string>& words);

}  // namespace plumb
