#include "platform/config.hpp"
#include "plumb_paths.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "modules/chain/plumb_config.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

struct Settings {
  double height_m = 1.65;
  int max_tracks = 500;
  bool rectify = false;
  std::string model = "pinhole";
  std::string folder;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("ground.camera_height_m", c.height_m, 0.3, 4.0, "height");
    field("vo.max_tracks", c.max_tracks, 64, 2000, "tracks");
    field("camera.lens.rectify", c.rectify, "rectify");
    field("camera.lens.model", c.model, {"pinhole", "fisheye"}, "lens");
    field("camera.folder", c.folder, "where \"images\" are");
  }
};

// The error of loading `text`, with the file's name replaced; empty when the text is accepted.
std::string refusal(const std::string& text, Settings* settings = nullptr) {
  const test::TempFile file(".toml", text);
  Settings own;
  try {
    load_config(file.path(), settings != nullptr ? settings : &own);
  } catch (const ConfigError& error) {
    std::string what = error.what();
    const std::size_t at = what.find(file.path());
    return at == std::string::npos ? what : what.replace(at, file.path().size(), "bad.toml");
  }
  return "";
}

TEST(Config, ReadsEveryKindOfValue) {
  Settings s;
  EXPECT_EQ("", refusal("[ground]\ncamera_height_m = 2\n[vo]\nmax_tracks = 64\n[camera]\n"
                        "folder = 'a b'\nlens = { rectify = true, model = 'fisheye' }\n",
                        &s));
  EXPECT_EQ(2.0, s.height_m);
  EXPECT_EQ(64, s.max_tracks);
  EXPECT_TRUE(s.rectify);
  EXPECT_EQ("fisheye", s.model);
  EXPECT_EQ("a b", s.folder);
}

TEST(Config, KeepsDefaultsOfWhatTheFileLeavesOut) {
  Settings s;
  EXPECT_EQ("", refusal("vo.max_tracks = 100\n", &s));
  EXPECT_EQ(1.65, s.height_m);
  EXPECT_EQ("", refusal(""));
}

TEST(Config, NamesFileLineKeyAndRange) {
  EXPECT_EQ("bad.toml:7: ground.camera_height_m = 145 is outside [0.3, 4]",
            refusal("# a\n# b\n\n\n\n[ground]\ncamera_height_m = 145\n"));
  EXPECT_EQ("bad.toml:2: vo.max_tracks = 2001 is outside [64, 2000]",
            refusal("[vo]\nmax_tracks = 2001\n"));
  EXPECT_EQ("bad.toml:1: ground.camera_height_m = nan is outside [0.3, 4]",
            refusal("ground.camera_height_m = nan"));
  EXPECT_EQ("bad.toml:1: vo.max_tracks = 9223372036854775807 is outside [64, 2000]",
            refusal("vo.max_tracks = 9223372036854775807"));
}

TEST(Config, AcceptsBothEndsOfARange) {
  EXPECT_EQ("", refusal("vo.max_tracks = 64\nground.camera_height_m = 0.3"));
  EXPECT_EQ("", refusal("vo.max_tracks = 2000\nground.camera_height_m = 4.0"));
}

TEST(Config, RefusesTheWrongType) {
  EXPECT_EQ("bad.toml:1: ground.camera_height_m = 'high' is not a number",
            refusal("ground.camera_height_m = 'high'"));
  EXPECT_EQ("bad.toml:1: vo.max_tracks = 100.5 is not a whole number",
            refusal("vo.max_tracks = 100.5"));
  EXPECT_EQ("bad.toml:1: camera.lens.rectify = 1 is neither true nor false",
            refusal("camera.lens.rectify = 1"));
  EXPECT_EQ("bad.toml:1: camera.folder = 3 is not text in quotes", refusal("camera.folder = 3"));
  EXPECT_EQ(
      "bad.toml:1: camera.lens.model = 'fish' is none of pinhole, fisheye; did you mean fisheye?",
      refusal("camera.lens.model = 'fish'"));
  EXPECT_EQ("bad.toml:1: vo.max_tracks = [ 100 ] is not a whole number",
            refusal("vo.max_tracks = [100]"));
}

TEST(Config, RefusesKeysThatNobodyOwnsAndSuggestsTheNearest) {
  EXPECT_EQ(
      "bad.toml:3: ground.camera_hight_m is not a known key; did you mean ground.camera_height_m?",
      refusal("[ground]\n\ncamera_hight_m = 1.5\n"));
  EXPECT_EQ("bad.toml:1: weather is not a known key", refusal("weather = 'fine'\n"));
  EXPECT_EQ("bad.toml:2: wheels is not a known section", refusal("vo.max_tracks=100\n[wheels]\n"));
  EXPECT_EQ("bad.toml:1: vo is not a known key", refusal("vo = 3\n"));
  EXPECT_EQ("", refusal("[camera]\n[camera.lens]\n")) << "an empty known section is no error";
}

TEST(Config, ReportsTheFirstUnknownKeyOfTheFile) {
  EXPECT_EQ("bad.toml:1: zzz is not a known key", refusal("zzz = 1\naaa = 2\n"));
}

TEST(Config, SaysWhereTheSyntaxBreaks) {
  const std::string broken = refusal("[vo]\nmax_tracks = = 3\n");
  EXPECT_EQ(0U, broken.find("bad.toml:2:14: ")) << broken;
  EXPECT_NE("", refusal("[vo]\nmax_tracks = 100\nmax_tracks = 200\n")) << "a key given twice";
}

TEST(Config, SaysWhyAFileCannotBeRead) {
  Settings s;
  try {
    load_config("/nowhere/at/all.toml", &s);
    FAIL() << "accepted a file that does not exist";
  } catch (const ConfigError& error) {
    EXPECT_STREQ("cannot read /nowhere/at/all.toml: No such file or directory", error.what());
  }
  try {
    load_config("/", &s);
    FAIL() << "accepted a folder";
  } catch (const ConfigError& error) {
    EXPECT_STREQ("cannot read /: Is a directory", error.what());
  }
}

TEST(Config, WritesWhatItReads) {
  Settings s;
  s.height_m = 0.1 + 0.2;  // this sum needs 17 digits
  s.max_tracks = 2000;
  s.rectify = true;
  s.model = "fisheye";
  s.folder = "quote \" backslash \\ tab \t end";
  Settings back;
  EXPECT_EQ("", refusal(render_config(s), &back));
  EXPECT_EQ(s.height_m, back.height_m);
  EXPECT_EQ(s.max_tracks, back.max_tracks);
  EXPECT_EQ(s.rectify, back.rectify);
  EXPECT_EQ(s.model, back.model);
  EXPECT_EQ(s.folder, back.folder);
}

TEST(Config, WritesRangeAndMeaningBesideEveryKey) {
  const std::string text = render_config(Settings{});
  EXPECT_NE(std::string::npos, text.find("[ground]\ncamera_height_m = 1.65          # [0.3, 4] "
                                         "height\n"))
      << text;
  EXPECT_NE(std::string::npos, text.find("[camera.lens]\n")) << text;
  EXPECT_NE(std::string::npos, text.find("one of \"pinhole\", \"fisheye\" lens\n")) << text;
}

TEST(Config, RefusesLimitsThatContradictEachOther) {
  const auto refusal_of_all = [](const std::string& text) {
    const test::TempFile file(".toml", text);
    PlumbConfig config;
    try {
      load_config(file.path(), &config);
    } catch (const ConfigError& error) {
      return std::string(error.what()).substr(file.path().size());
    }
    return std::string();
  };
  EXPECT_EQ("", refusal_of_all("[ground]\nroad_near_m = 9\nroad_far_m = 9.1\n"));
  EXPECT_EQ(": ground.road_near_m is not below ground.road_far_m",
            refusal_of_all("[ground]\nroad_near_m = 9\nroad_far_m = 9\n"));
  EXPECT_EQ(": vehicle.min_height_m is not below vehicle.max_height_m",
            refusal_of_all("[vehicle]\nmin_height_m = 3\nmax_height_m = 2\n"));
  EXPECT_EQ("", refusal_of_all("[camera]\nretry_min_s = 3\nretry_max_s = 3\n"));
  EXPECT_EQ(": camera.retry_min_s is above camera.retry_max_s",
            refusal_of_all("[camera]\nretry_min_s = 3\nretry_max_s = 2\n"));
}

TEST(Config, DefaultTomlIsTheGeneratedText) {
  std::ifstream in(std::string(PLUMB_SOURCE_DIR) + "/config/default.toml", std::ios::binary);
  const std::string committed{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(render_config(PlumbConfig{}), committed)
      << "update it with: plumb-vo --print-config > config/default.toml";
}

TEST(Config, EveryDefaultIsInsideItsOwnRange) {
  const test::TempFile file(".toml", render_config(PlumbConfig{}));
  PlumbConfig config;
  EXPECT_NO_THROW(load_config(file.path(), &config));
}

}  // namespace
}  // namespace plumb
