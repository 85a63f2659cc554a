#include "viewer/shading.hpp"

#include <fmt/format.h>

namespace relevo::viewer {

std::string_view to_string(Shading shading) {
    switch (shading) {
        case Shading::multidirectional:
            return "multidirectional";
        case Shading::oblique:
            return "oblique";
        case Shading::combined:
            return "combined";
        case Shading::sun:
            break;
    }
    return "sun";
}

Result<Shading> parse_shading(std::string_view text) {
    for (const Shading shading :
         {Shading::sun, Shading::multidirectional, Shading::oblique, Shading::combined}) {
        if (text == to_string(shading)) return shading;
    }
    return Error{ErrorKind::usage,
                 fmt::format("no shading \"{}\": sun, multidirectional, oblique or combined", text)};
}

}  // namespace relevo::viewer
