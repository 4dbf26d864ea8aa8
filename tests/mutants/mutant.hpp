/// What mutated sources call. tests/mutants/mutate.py writes the calls, tests/mutants/run sets
/// PLUMB_MUTANT to the number of the mutant that is active; 0, the default: none is.
///
/// With PLUMB_MUTANTS_REACHED, the numbers of all mutants that were passed are written to that file
/// when the program ends.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace plumb_mutant {

class Reached {
 public:
  ~Reached() {
    const char* path = std::getenv("PLUMB_MUTANTS_REACHED");
    std::FILE* file = path != nullptr ? std::fopen(path, "w") : nullptr;
    if (file == nullptr) return;
    for (std::size_t i = 0; i < passed_.size(); ++i)
      if (passed_[i]) std::fprintf(file, "%zu\n", i);
    std::fclose(file);
  }
  void pass(std::size_t id) {
    if (id >= passed_.size()) passed_.resize(id + 1);
    passed_[id] = true;
  }

 private:
  std::vector<bool> passed_;
};

inline int active() {
  static const int kActive = [] {
    const char* text = std::getenv("PLUMB_MUTANT");
    return text != nullptr ? std::atoi(text) : 0;
  }();
  return kActive;
}

inline bool on(int id) {
  static const bool kWatches = std::getenv("PLUMB_MUTANTS_REACHED") != nullptr;
  if (kWatches) {
    static Reached reached;
    reached.pass(static_cast<std::size_t>(id));
  }
  return active() == id;
}

inline bool flip(int id, bool value) { return on(id) != value; }
template <typename T>
T number(int id, T value) {
  return on(id) ? static_cast<T>(value + 1) : value;
}
template <typename R>
bool both(int id, bool left, R right) {
  return on(id) ? left || right() : left && right();
}
template <typename R>
bool either(int id, bool left, R right) {
  return on(id) ? left && right() : left || right();
}

// NAME(id, a, b) is a OP b, or a INSTEAD b where that compiles.
#define PLUMB_MUTANT_OPERATOR(NAME, OP, INSTEAD)                  \
  template <typename A, typename B>                               \
  auto NAME(int id, const A& a, const B& b) {                     \
    using Result = decltype(a OP b);                              \
    if constexpr (requires { static_cast<Result>(a INSTEAD b); }) \
      if (on(id)) return static_cast<Result>(a INSTEAD b);        \
    return a OP b;                                                \
  }
PLUMB_MUTANT_OPERATOR(plus, +, -)
PLUMB_MUTANT_OPERATOR(minus, -, +)
PLUMB_MUTANT_OPERATOR(times, *, /)
PLUMB_MUTANT_OPERATOR(over, /, *)
PLUMB_MUTANT_OPERATOR(modulo, %, *)
PLUMB_MUTANT_OPERATOR(bit_and, &, |)
PLUMB_MUTANT_OPERATOR(bit_or, |, &)
PLUMB_MUTANT_OPERATOR(bit_xor, ^, &)
PLUMB_MUTANT_OPERATOR(left_shift, <<, >>)
PLUMB_MUTANT_OPERATOR(right_shift, >>, <<)
PLUMB_MUTANT_OPERATOR(equal, ==, !=)
PLUMB_MUTANT_OPERATOR(unequal, !=, ==)
#undef PLUMB_MUTANT_OPERATOR

// NAME(id, a, b) has two mutants: id moves the limit, id + 1 turns the comparison round.
#define PLUMB_MUTANT_COMPARISON(NAME, OP, SHIFTED, TURNED) \
  template <typename A, typename B>                        \
  bool NAME(int id, const A& a, const B& b) {              \
    if (on(id)) return a SHIFTED b;                        \
    if (on(id + 1)) return a TURNED b;                     \
    return a OP b;                                         \
  }
PLUMB_MUTANT_COMPARISON(less, <, <=, >=)
PLUMB_MUTANT_COMPARISON(less_equal, <=, <, >)
PLUMB_MUTANT_COMPARISON(greater, >, >=, <=)
PLUMB_MUTANT_COMPARISON(greater_equal, >=, >, <)
#undef PLUMB_MUTANT_COMPARISON

}  // namespace plumb_mutant
