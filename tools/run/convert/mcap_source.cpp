#include "tools/run/convert/mcap_source.hpp"

#include <set>

#include "core/input_error.hpp"
#include "modules/datasets/text.hpp"

namespace plumb {
namespace {

/// The topics with images in a file. One without a summary is read to its end.
std::set<std::string> image_topics(const std::string& file) {
  McapReader reader(file);
  McapMessage message;
  if (reader.channels().empty()) {
    try {
      while (reader.next(&message)) {
      }
    } catch (const InputError&) {  // A damaged place is reported when its images are read.
    }
  }
  std::set<std::string> topics;
  for (const auto& [number, channel] : reader.channels()) {
    if (has_images(channel)) topics.insert(channel.topic);
  }
  return topics;
}

}  // namespace

McapSource::McapSource(const std::string& file, const std::string& topic)
    : file_(file), reader_(file) {
  choose(topic);
  first_is_loaded_ = load();
  if (!first_is_loaded_) throw InputError(file + ": no image on " + topic_);
  for (const auto& [number, channel] : reader_.channels()) {
    if (channel.topic == topic_) num_frames_ += reader_.num_messages(number);
  }
}

void McapSource::choose(const std::string& topic) {
  const std::set<std::string> topics = image_topics(file_);
  std::string list;
  for (const std::string& known : topics) list += (list.empty() ? "" : ", ") + known;
  if (topics.empty()) {
    throw InputError(file_ +
                     ": no topic with images (sensor_msgs/msg/CompressedImage, "
                     "sensor_msgs/msg/Image, foxglove.CompressedImage)");
  }
  if (topic.empty() && topics.size() > 1)
    throw InputError(file_ + ": several topics with images, choose one by --topic: " + list);
  topic_ = topic.empty() ? *topics.begin() : topic;
  if (topics.count(topic_) == 0)
    throw InputError(file_ + ": no images on " + topic_ + "; there are some on " + list);
}

/// Reads the next image of the topic. False after the last.
bool McapSource::load() {
  McapMessage message;
  while (reader_.next(&message)) {
    const McapChannel& channel = reader_.channels().at(message.channel);
    if (channel.topic != topic_ || !has_images(channel)) continue;
    const cv::Size size = image_.grey.size();
    const std::string at = format("%s: image %lld on %s: ", file_.c_str(),
                                  static_cast<long long>(num_loaded_), topic_.c_str());
    if (const char* why = read_image_message(channel, message.data, &image_))
      throw InputError(at + why);
    if (image_.stamp_us <= 0) throw InputError(at + "it has no time stamp");
    if (num_loaded_ > 0 && image_.grey.size() != size)
      throw InputError(at + "it has another size than the images before it");
    ++num_loaded_;
    return true;
  }
  return false;
}

void McapSource::complete(CameraConfig* config) const {
  complete_size(file_, image_.grey.cols, image_.grey.rows, config);
}

bool McapSource::read(GreyFrame* frame) {
  if (!first_is_loaded_ && !load()) return false;
  first_is_loaded_ = false;
  const cv::Mat& grey = image_.grey;
  *frame = {image_.stamp_us,
            num_loaded_ - 1,
            {grey.data, grey.cols, grey.rows, static_cast<std::ptrdiff_t>(grey.step[0])}};
  return true;
}

}  // namespace plumb
