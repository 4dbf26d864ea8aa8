#include "platform/command_line.hpp"

#include <gtest/gtest.h>

namespace plumb {
namespace {

/// A program with every kind of option, and two commands.
struct Program {
  Program() {
    app.add_option("LOG", log);
    app.add_option("--seed", seed).check(within(1, 9));
    app.add_option("--start", start).check(at_least(0));
    app.add_option("--count", count);
    app.add_option("--compress", compress).check(one_of({"none", "jpeg"}));
    app.add_option("--poses", poses);
  }
  void add_commands() {
    app.require_subcommand(1, 1);
    CommandLine sample = app.add_subcommand("sample", "");
    sample.add_option("--planes", poses);
    sample.add_option("--out", out).required();
    app.add_subcommand("score", "");
  }
  /// The sentence on stderr; empty when the line is accepted.
  std::string sentence(std::vector<std::string> words) {
    words.insert(words.begin(), "plumb-test");
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    testing::internal::CaptureStderr();
    const int code = app.parse(static_cast<int>(argv.size()), argv.data());
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_EQ(text.empty() ? -1 : 2, code) << text;
    return text;
  }

  CommandLine app{"a test", "plumb-test"};
  std::string log, compress, poses, out;
  int seed = 1, start = 0, count = 0;
};

constexpr const char* kHelp = " (--help lists the options)\n";

TEST(CommandLine, AcceptsWhatItKnows) {
  Program program;
  EXPECT_EQ("", program.sentence({"a.lcm", "--seed", "9", "--compress", "jpeg", "--start", "0"}));
  EXPECT_EQ(9, program.seed);
  EXPECT_EQ("jpeg", program.compress);
}

TEST(CommandLine, NamesTheNearestOption) {
  EXPECT_EQ("plumb-test: unknown option --pose; did you mean --poses?\n",
            Program().sentence({"a.lcm", "--pose", "p.txt"}));
  EXPECT_EQ("plumb-test: unknown option --pose; did you mean --poses?\n",
            Program().sentence({"--pose=p.txt"}));
  EXPECT_EQ("plumb-test: unknown option -poses; did you mean --poses?\n",
            Program().sentence({"-poses", "p.txt"}));
  EXPECT_EQ(std::string("plumb-test: unknown option --frobnicate") + kHelp,
            Program().sentence({"--frobnicate"}));
}

TEST(CommandLine, RefusesAnArgumentTooMany) {
  EXPECT_EQ(std::string("plumb-test: unexpected argument b.lcm") + kHelp,
            Program().sentence({"a.lcm", "b.lcm"}));
}

TEST(CommandLine, NamesTheNearestCommandAndItsOptions) {
  Program typo;
  typo.add_commands();
  EXPECT_EQ("plumb-test: unknown command smaple; did you mean sample?\n",
            typo.sentence({"smaple", "a.lcm", "--out", "b"}));
  Program option;
  option.add_commands();
  EXPECT_EQ("plumb-test: unknown option --plane; did you mean --planes?\n",
            option.sentence({"sample", "--plane", "p.txt"}))
      << "an unknown option says more than the missing --out";
}

TEST(CommandLine, SaysWhatIsWrongWithAValue) {
  EXPECT_EQ(std::string("plumb-test: --seed: 10 is outside [1, 9]") + kHelp,
            Program().sentence({"--seed", "10"}));
  EXPECT_EQ(std::string("plumb-test: --seed: some is not a number") + kHelp,
            Program().sentence({"--seed", "some"}));
  EXPECT_EQ(std::string("plumb-test: --seed: nan is outside [1, 9]") + kHelp,
            Program().sentence({"--seed", "nan"}));
  EXPECT_EQ(std::string("plumb-test: --seed: 1.5 is not a whole number in range") + kHelp,
            Program().sentence({"--seed", "1.5"}));
  EXPECT_EQ(std::string("plumb-test: --count: many is not a number") + kHelp,
            Program().sentence({"--count", "many"}));
  EXPECT_EQ(std::string("plumb-test: --start: -1 is below 0") + kHelp,
            Program().sentence({"--start", "-1"}));
  EXPECT_EQ("plumb-test: --compress: jpg is none of none, jpeg; did you mean jpeg?\n",
            Program().sentence({"--compress", "jpg"}));
  EXPECT_EQ(std::string("plumb-test: --poses wants a value") + kHelp,
            Program().sentence({"--poses"}));
}

}  // namespace
}  // namespace plumb
