// Whether a rung stops what is no light - infinite, negative, not a number - or lets it spread, as a setting:
// a guard is best understood by its absence.
#pragma once

#include "rung/settings.hpp"

namespace gll {
inline namespace hdr {

struct Guard {
    explicit Guard(Settings& settings)
        : on(settings.toggle("guard", true,
                             "whether values that are no light, infinite or not a number, are stopped")) {}

    // For the shader variants that stop such values unless UNGUARDED is defined.
    Defines defines() const { return on ? Defines{} : Defines{{"UNGUARDED", "1"}}; }

    Toggle on;
};

} // namespace hdr
} // namespace gll
