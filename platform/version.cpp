#include "platform/version.hpp"

namespace plumb {

const char* plumb_version() { return PLUMB_VERSION; }

}  // namespace plumb
