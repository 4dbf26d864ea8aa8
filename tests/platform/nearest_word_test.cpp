#include "platform/nearest_word.hpp"

#include <gtest/gtest.h>

namespace plumb {
namespace {

TEST(EditDistance, CountsInsertedDeletedReplacedAndSwappedLetters) {
  EXPECT_EQ(0U, edit_distance("", ""));
  EXPECT_EQ(0U, edit_distance("poses", "poses"));
  EXPECT_EQ(1U, edit_distance("pose", "poses"));
  EXPECT_EQ(1U, edit_distance("posses", "poses"));
  EXPECT_EQ(1U, edit_distance("pores", "poses"));
  EXPECT_EQ(1U, edit_distance("cvs", "csv"));
  EXPECT_EQ(3U, edit_distance("ca", "abc")) << "a swapped pair is not edited again";
  EXPECT_EQ(5U, edit_distance("", "poses"));
}

TEST(NearestWord, TakesTheClosestAndTheFirstOfEquals) {
  const std::vector<std::string> known = {"--poses", "--planes", "--csv", "--camera-height"};
  EXPECT_EQ("--poses", nearest_word("--pose", known));
  EXPECT_EQ("--csv", nearest_word("--cvs", known));
  EXPECT_EQ("aab", nearest_word("aaa", {"aab", "aac"}));
  EXPECT_EQ("k1", nearest_word("k3", {"k1", "k2", "focal"}));
  EXPECT_EQ("", nearest_word("k", {"x", "y"}));
}

TEST(NearestWord, FallsBackToAWordThatContainsTheOther) {
  const std::vector<std::string> known = {"--poses", "--camera-height"};
  EXPECT_EQ("--camera-height", nearest_word("--height", known));
  EXPECT_EQ("--poses", nearest_word("--poses-of-the-truth", known));
  EXPECT_EQ("", nearest_word("--era", known)) << "three letters say too little";
}

TEST(NearestWord, IsSilentWhenNothingIsNear) {
  EXPECT_EQ("", nearest_word("--frobnicate", {"--poses", "--csv"}));
  EXPECT_EQ("", nearest_word("word", {}));
  EXPECT_EQ("", did_you_mean("--frobnicate", {"--poses"}));
  EXPECT_EQ("; did you mean jpeg?", did_you_mean("jpg", {"none", "jpeg"}));
}

TEST(WordList, PutsCommasBetweenWords) {
  EXPECT_EQ("", word_list({}));
  EXPECT_EQ("a", word_list({"a"}));
  EXPECT_EQ("a, b, c", word_list({"a", "b", "c"}));
}

}  // namespace
}  // namespace plumb
