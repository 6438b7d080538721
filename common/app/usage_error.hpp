// The error of a caller: an unknown name, a value out of range. Programs end with exit code 2 on it, 1 on any
// other.
#pragma once

#include <stdexcept>

namespace gll {

struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

} // namespace gll
