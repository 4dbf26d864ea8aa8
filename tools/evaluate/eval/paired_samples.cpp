#include "tools/evaluate/eval/paired_samples.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <random>
#include <tuple>

#include "core/input_error.hpp"
#include "modules/datasets/text.hpp"
#include "tools/support/csv_table.hpp"
#include "tools/support/statistics.hpp"

namespace plumb {
namespace {

constexpr int kNumDraws = 2000;
constexpr std::uint64_t kDrawSeed = 1;

using SampleKey = std::tuple<std::string, std::int64_t, std::string>;

std::map<SampleKey, double> by_key(const std::vector<ErrorSample>& samples,
                                   const std::string& kind) {
  std::map<SampleKey, double> found;
  for (const ErrorSample& sample : samples) {
    if (kind.empty()) found[{sample.drive, sample.frame, sample.kind}] = sample.value;
    if (!kind.empty() && sample.kind == kind)
      found[{sample.drive, sample.frame, {}}] = sample.value;
  }
  return found;
}

/// Sums over the pairs of some neighbouring frames.
struct PairBlock {
  double num = 0.0;
  double of = 0.0;
  double against = 0.0;

  void add(const PairBlock& other) {
    num += other.num;
    of += other.of;
    against += other.against;
  }
};

std::vector<PairBlock> blocks_of(const std::map<SampleKey, double>& of,
                                 const std::map<SampleKey, double>& against, int block_frames) {
  std::map<std::pair<std::string, std::int64_t>, PairBlock> blocks;
  for (const auto& [key, value] : of) {
    const auto other = against.find(key);
    if (other == against.end()) continue;
    blocks[{std::get<0>(key), std::get<1>(key) / block_frames}].add({1.0, value, other->second});
  }
  std::vector<PairBlock> list;
  for (const auto& [at, block] : blocks) list.push_back(block);
  return list;
}

Interval interval(double value, const std::vector<double>& draws) {
  return {value, quantile(draws, 0.025), quantile(draws, 0.975)};
}

}  // namespace

std::vector<ErrorSample> read_error_samples(const std::filesystem::path& path) {
  const CsvTable table(path);
  table.require({"drive", "frame", "kind", "value"});
  std::vector<ErrorSample> samples;
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    const auto frame = table.number(row, "frame");
    const auto value = table.number(row, "value");
    if (!frame || !value) throw InputError(table.at(row) + "frame or value is empty");
    samples.push_back({std::string(*table.text(row, "drive")), static_cast<std::int64_t>(*frame),
                       std::string(*table.text(row, "kind")), *value});
  }
  return samples;
}

void write_error_samples(const std::vector<ErrorSample>& samples,
                         const std::filesystem::path& path) {
  std::ofstream file(path);
  file << "drive,frame,kind,value\n";
  for (const ErrorSample& s : samples) {
    file << s.drive << ',' << s.frame << ',' << s.kind << ',' << format("%.9g", s.value) << '\n';
  }
  file.close();
  if (!file) throw InputError("cannot write " + path.string());
}

PairedComparison compare_samples(const std::vector<ErrorSample>& of,
                                 const std::vector<ErrorSample>& against,
                                 const ComparisonOptions& options) {
  const std::vector<PairBlock> blocks =
      blocks_of(by_key(of, options.of), by_key(against, options.against), options.block_frames);
  if (blocks.empty()) throw InputError("the two files have no sample in common");
  PairBlock all;
  for (const PairBlock& block : blocks) all.add(block);
  std::vector<double> of_draws, against_draws, difference_draws;
  std::mt19937_64 random(kDrawSeed);
  for (int draw = 0; draw < kNumDraws; ++draw) {
    PairBlock sum;
    for (std::size_t i = 0; i < blocks.size(); ++i) sum.add(blocks[random() % blocks.size()]);
    of_draws.push_back(sum.of / sum.num);
    against_draws.push_back(sum.against / sum.num);
    difference_draws.push_back((sum.of - sum.against) / sum.num);
  }
  return {static_cast<int>(all.num), static_cast<int>(blocks.size()),
          interval(all.of / all.num, of_draws), interval(all.against / all.num, against_draws),
          interval((all.of - all.against) / all.num, difference_draws)};
}

}  // namespace plumb
