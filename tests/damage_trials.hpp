#pragma once

#include <cstdlib>

namespace relevo::test {

/// How often a test damages something. RELEVO_DAMAGE_TRIALS=10000 asks for more than a test has time for.
inline int damage_trials(int usual) {
    const char* asked = std::getenv("RELEVO_DAMAGE_TRIALS");
    return asked == nullptr ? usual : std::atoi(asked);
}

}  // namespace relevo::test
