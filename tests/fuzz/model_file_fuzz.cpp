// A fuzz target for files of trained models. What is accepted must be accepted again as plumb-train
// writes it.
#include "modules/chain/model_file_source.hpp"
#include "platform/config.hpp"
#include "tests/fuzz/fuzz_input.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const plumb::fuzz::MemoryFile kFile;
  kFile.write(plumb::fuzz::Bytes{data, size});
  plumb::TrainedModels models;
  try {
    models = plumb::load_models(kFile.path());
  } catch (const plumb::ConfigError&) {
    return 0;
  }
  kFile.write(plumb::models_text(models));
  (void)plumb::load_models(kFile.path());
  return 0;
}
