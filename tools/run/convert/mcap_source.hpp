/// A camera's topic in an MCAP file as a recording.
///
/// Sequence:
///   The images are counted, because the messages carry no numbers.
/// Time:
///   The stamps in the messages.
#pragma once

#include <optional>
#include <string>

#include "modules/camera/recorded_source.hpp"
#include "tools/run/convert/image_message.hpp"

namespace plumb {

class McapSource final : public RecordedSource {
 public:
  /// Looks for the topic and reads its first image. An empty `topic` means the only one with
  /// images. Throws InputError, which lists the topics with images.
  McapSource(const std::string& file, const std::string& topic);

  void complete(CameraConfig* config) const override;
  [[nodiscard]] bool read(GreyFrame* frame) override;
  [[nodiscard]] std::int64_t num_frames() const override { return num_frames_; }

 private:
  void choose(const std::string& topic);
  bool load();

  std::string file_;
  McapReader reader_;
  std::string topic_;
  std::int64_t num_frames_ = 0;
  std::int64_t num_loaded_ = 0;
  bool first_is_loaded_ = false;
  StampedImage image_;
};

}  // namespace plumb
