// Runs a fuzz target without libFuzzer: on each file of a corpus, and on mutations of them that
// depend on the seed alone.
//
//   TARGET CORPUS NUM_MUTATIONS [SEED]
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kMaxInput = 16'384;

std::vector<Bytes> read_corpus(const char* folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry);
  std::sort(paths.begin(), paths.end());
  std::vector<Bytes> corpus;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return corpus;
}

class Mutator {
 public:
  Mutator(const std::vector<Bytes>& corpus, std::uint32_t seed) : corpus_(corpus), random_(seed) {}

  Bytes next() {
    Bytes input = pick();
    for (std::size_t k = 1 + random_() % 6; k > 0; --k) mutate(&input);
    input.resize(std::min(input.size(), kMaxInput));
    return input;
  }

 private:
  const Bytes& pick() { return corpus_[random_() % corpus_.size()]; }
  std::ptrdiff_t place(const Bytes& input) {
    return static_cast<std::ptrdiff_t>(random_() % (input.size() + 1));
  }
  void mutate(Bytes* input) {
    const auto value = static_cast<std::uint8_t>(random_());
    switch (random_() % 6) {
      case 0:
        input->insert(input->begin() + place(*input), value);
        break;
      case 1: {
        const Bytes& other = pick();
        const auto from = other.begin() + place(other);
        input->insert(input->begin() + place(*input), from, other.end());
        break;
      }
      case 2:
        input->erase(input->begin() + place(*input), input->end());
        break;
      default:
        if (input->empty()) return;
        if (value % 2 == 0)
          (*input)[random_() % input->size()] = static_cast<std::uint8_t>(random_());
        else
          (*input)[random_() % input->size()] ^= static_cast<std::uint8_t>(1U << random_() % 8);
    }
  }

  const std::vector<Bytes>& corpus_;
  std::mt19937 random_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: %s CORPUS NUM_MUTATIONS [SEED]\n", argv[0]);
    return 2;
  }
  const std::vector<Bytes> corpus = read_corpus(argv[1]);
  if (corpus.empty()) {
    std::fprintf(stderr, "%s: %s has no file\n", argv[0], argv[1]);
    return 2;
  }
  for (const Bytes& input : corpus) LLVMFuzzerTestOneInput(input.data(), input.size());
  const auto seed = static_cast<std::uint32_t>(argc > 3 ? std::atoll(argv[3]) : 1);
  Mutator mutator(corpus, seed);
  const long long num_mutations = std::atoll(argv[2]);
  for (long long i = 0; i < num_mutations; ++i) {
    const Bytes input = mutator.next();
    LLVMFuzzerTestOneInput(input.data(), input.size());
  }
  std::printf("%zu inputs and %lld mutations, seed %u\n", corpus.size(), num_mutations, seed);
  return 0;
}
