/// The interface by which a library without a clock lets its caller time its stages.
#pragma once

namespace plumb {

class StageProbe {
 public:
  virtual ~StageProbe() = default;
  /// Ends the stage `name`, which began at the previous mark() or at begin().
  /// `name` is a string literal.
  virtual void mark(const char* name) = 0;
  /// Begins a frame.
  virtual void begin() = 0;
};

/// A probe that measures nothing.
class NullProbe final : public StageProbe {
 public:
  void mark(const char* /*name*/) override {}
  void begin() override {}
};

}  // namespace plumb
