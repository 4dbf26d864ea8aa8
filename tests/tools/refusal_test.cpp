/// Every program refuses outputs that would overwrite an input or each other, and says which option
/// or value it does not know.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <map>

#include "tests/support/run_program.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;

struct Call {
  const char* program;
  std::string arguments;
  const char* sentence;
};

/// Inputs that must stay as they are. Their content does not matter: the programs refuse before
/// they read.
class OverwriteRefusal : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name :
         {"log.lcm", "poses.txt", "est.txt", "frames.csv", "objects.csv", "config.toml",
          "samples.csv", "model.toml", "drive/times.txt", "drive/poses.txt",
          "drive/image_0/000000.png", "drive/label_02/0000.txt"}) {
      folder_.write(name, std::string("content of ") + name);
    }
    fs::create_symlink("log.lcm", folder_ / "soft.lcm");
    fs::create_hard_link(folder_ / "log.lcm", folder_ / "hard.lcm");
  }
  /// Content and inode of every file; what the shell writes is left out.
  [[nodiscard]] std::map<std::string, std::pair<ino_t, std::string>> files() const {
    std::map<std::string, std::pair<ino_t, std::string>> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename().string();
      if (!entry.is_regular_file() || name == "stdout.txt" || name == "stderr.txt") continue;
      struct stat status {};
      ::stat(entry.path().c_str(), &status);
      found[entry.path().string()] = {status.st_ino, test::read_text(entry.path())};
    }
    return found;
  }
  void expect_refused(const Call& call) const {
    const auto before = files();
    test::expect_refused(folder_, call.program, in_folder(call.arguments), call.sentence);
    EXPECT_TRUE(files() == before) << call.program << " " << call.arguments;
  }
  /// Puts the folder's path in place of every @.
  [[nodiscard]] std::string in_folder(std::string text) const {
    const std::string path = folder_.path().string();
    for (std::size_t at = 0; (at = text.find('@', at)) != std::string::npos; at += path.size())
      text.replace(at, 1, path);
    return text;
  }
  test::TempFolder folder_;
};

TEST_F(OverwriteRefusal, Replay) {
  for (const Call& call : std::vector<Call>{
           {"plumb-replay", "@/log.lcm --poses @/log.lcm", "would overwrite the input LOG"},
           {"plumb-replay", "@/log.lcm --csv @/soft.lcm", "would overwrite the input LOG"},
           {"plumb-replay", "@/log.lcm --objects @/hard.lcm", "would overwrite the input LOG"},
           {"plumb-replay", "@/log.lcm --can @/drive/../log.lcm", "would overwrite the input LOG"},
           {"plumb-replay", "@/log.lcm --config @/config.toml --csv @/config.toml",
            "would overwrite the input --config"},
           {"plumb-replay", "@/log.lcm --poses @/new.txt --csv @/new.txt", "is the same file as"},
           {"plumb-replay", "@/log.lcm --poses @/new.txt --can @/./new.txt",
            "--can " /* the later one is named first */}}) {
    expect_refused(call);
  }
}

TEST_F(OverwriteRefusal, Kitti2lcm) {
  for (const Call& call : std::vector<Call>{
           {"plumb-kitti2lcm", "@/drive --out @/drive/times.txt", "of the input SEQ_DIR"},
           {"plumb-kitti2lcm", "@/drive --out @/drive/image_0/000000.png", "of the input SEQ_DIR"},
           {"plumb-kitti2lcm", "@/drive --poses @/poses.txt --out @/poses.txt", "--poses"},
           {"plumb-kitti2lcm", "@/drive --detections @/est.txt --out @/est.txt", "--detections"}}) {
    expect_refused(call);
  }
}

TEST_F(OverwriteRefusal, Convert) {
  folder_.write("drive.mp4", "content of drive.mp4");
  folder_.write("drive/image_0/000001.JPG", "content of 000001.JPG");
  fs::create_symlink("drive.mp4", folder_ / "soft.mp4");
  for (const Call& call : std::vector<Call>{
           {"plumb-convert", "@/drive.mp4 --camera @/config.toml --out @/soft.mp4", "RECORDING"},
           {"plumb-convert", "@/drive.mp4 --camera @/config.toml --out @/config.toml", "--camera"},
           {"plumb-convert", "@/drive/image_0 --camera @/config.toml --out @/drive/times.txt",
            "times.txt"},
           {"plumb-convert",
            "@/drive/image_0 --camera @/config.toml --times @/est.txt --out @/est.txt", "--times"},
           {"plumb-convert",
            "@/drive/image_0 --camera @/config.toml --out @/drive/image_0/000001.JPG",
            "would overwrite the input RECORDING"}}) {
    expect_refused(call);
  }
}

TEST_F(OverwriteRefusal, Eval) {
  for (const Call& call : std::vector<Call>{
           {"plumb-eval", "@/poses.txt @/est.txt --json @/est.txt", "the input EST"},
           {"plumb-eval", "@/poses.txt @/est.txt --json @/poses.txt", "the input GT"},
           {"plumb-eval", "--gt-dir @/drive --est-dir @ --json @/drive/poses.txt", "--gt-dir"},
           {"plumb-eval", "plane @/est.txt @/frames.csv --json @/frames.csv", "EST_CSV"},
           {"plumb-eval", "placed @/drive @/frames.csv @/objects.csv --json @/objects.csv",
            "OBJECTS"},
           {"plumb-eval", "placed @/drive @/frames.csv @/objects.csv --json @/drive/times.txt",
            "of the input DRIVE"},
           {"plumb-eval", "objects @/drive --json @/drive/label_02/0000.txt", "ROOT"}}) {
    expect_refused(call);
  }
}

TEST_F(OverwriteRefusal, TrainAndCalibrate) {
  for (const Call& call : std::vector<Call>{
           {"plumb-train", "sample @/log.lcm --out @/log.lcm --again", "the input LOG"},
           {"plumb-train", "fit @/samples.csv --out @/samples.csv", "the input SAMPLES"},
           {"plumb-train", "fit @/samples.csv --start @/model.toml --out @/model.toml", "--start"},
           {"plumb-train", "fit @/samples.csv --out @/new.toml --json @/new.toml", "same file"},
           {"plumb-train", "score @/samples.csv --json @/samples.csv", "the input SAMPLES"},
           {"plumb-calibrate", "@/log.lcm --out @/log.lcm", "the input LOG"},
           {"plumb-calibrate", "@/log.lcm --out @/new.toml --json @/new.toml", "same file"}}) {
    expect_refused(call);
  }
}

TEST_F(OverwriteRefusal, SynthAndCan) {
  for (const Call& call : std::vector<Call>{
           {"plumb-synth", "--poses @/drive/poses.txt --out @/drive --force", "--poses"},
           {"plumb-can", "--lcm-url memq:// --config @/empty.toml --trace @/empty.toml",
            "the input --config"}}) {
    folder_.write("empty.toml", "");
    expect_refused(call);
  }
}

TEST(UnknownWords, AreRefusedWithTheNearestKnownOne) {
  const test::TempFolder folder;
  for (const Call& call : std::vector<Call>{
           {"plumb-replay", "a.lcm --pose p.txt", "unknown option --pose; did you mean --poses?"},
           {"plumb-kitti2lcm", "a --ou b", "unknown option --ou; did you mean --out?"},
           {"plumb-kitti2lcm", "a --out b --compress jpg", "jpg is none of none, jpeg; did you"},
           {"plumb-convert", "a --out b --frames 3", "unknown option --frames"},
           {"plumb-convert", "a --out b --rat 3", "did you mean --rate?"},
           {"plumb-eval", "a b --plot-format pgn", "did you mean png?"},
           {"plumb-eval", "placed a b c --classes cars", "did you mean car?"},
           {"plumb-eval", "a b --jsn c", "did you mean --json?"},
           {"plumb-train", "smaple a --out b", "unknown command smaple; did you mean sample?"},
           {"plumb-train", "sample a --out b --sede 3", "did you mean --seed?"},
           {"plumb-calibrate", "a --parameter k1", "did you mean --parameters?"},
           {"plumb-calibrate", "a --parameters k3", "did you mean k1?"},
           {"plumb-draw", "a b --out c --fames 3", "did you mean --frames?"},
           {"plumb-synth", "--out a --camera-heigt 2", "did you mean --camera-height?"},
           {"plumb-synth", "--out a --route ctiy", "did you mean city?"},
           {"plumb-synth", "--out a --lead lorry", "lorry is none of none, car, truck"},
           {"plumb-vo", "--sed 3", "did you mean --seed?"},
           {"plumb-can", "--interfaces can0", "did you mean --interface?"},
           {"plumb-camera", "--kiti a", "did you mean --kitti?"},
           {"plumb-camera", "--image a", "did you mean --images?"}}) {
    test::expect_refused(folder, call.program, call.arguments, call.sentence);
  }
}

}  // namespace
}  // namespace plumb
