/// How a pure library lets its caller measure it without owning a clock.
#pragma once

namespace plumb {

class StageProbe {
 public:
  virtual ~StageProbe() = default;
  /// The stage `name` (a string literal) has just ended; it began at the previous mark or at
  /// `begin`.
  virtual void mark(const char* name) = 0;
  /// A frame begins.
  virtual void begin() = 0;
};

/// Measures nothing.
class NullProbe final : public StageProbe {
 public:
  void mark(const char* /*name*/) override {}
  void begin() override {}
};

}  // namespace plumb
