#include "viewer/bench/bench_options.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace relevo::viewer {

std::string_view to_string(BenchMethod method) {
    switch (method) {
        case BenchMethod::soar_bounded:
            return "soar-bounded";
        case BenchMethod::soar_incremental:
            return "soar-incremental";
        case BenchMethod::lstr:
            return "lstr";
        case BenchMethod::textbook:
            return "textbook";
        case BenchMethod::full:
            break;
    }
    return "full";
}

Result<BenchMethod> parse_bench_method(std::string_view text) {
    for (const BenchMethod method : BenchOptions{}.methods) {
        if (text == to_string(method)) return method;
    }
    return Error{
        ErrorKind::usage,
        fmt::format("no method \"{}\": soar-bounded, soar-incremental, lstr, textbook or full", text)};
}

std::vector<BenchSetting> bench_settings(const BenchOptions& options) {
    std::vector<BenchSetting> settings;
    for (const BenchMethod method : options.methods) {
        for (const bool morph : options.morphs) {
            // A method that does not know the morph is there once, whatever was asked for.
            if (!has_morph(method) && morph != options.morphs.front()) continue;
            const bool morphs = has_morph(method) && morph;
            if (!has_tau(method)) {
                settings.push_back({method, morphs, std::nullopt, false});
                continue;
            }
            for (const double tau : options.taus) settings.push_back({method, morphs, tau, false});
        }
    }
    if (!options.budget.any()) return settings;
    for (const bool morph : options.morphs) {
        const BenchSetting held{BenchMethod::soar_bounded, morph, options.look.tau_px, true};
        if (std::count(options.methods.begin(), options.methods.end(), held.method) > 0)
            settings.push_back(held);
    }
    return settings;
}

std::string_view series_name(const BenchSetting& setting) {
    switch (setting.method) {
        case BenchMethod::soar_bounded:
            return setting.morph ? "soar-bounded, morph" : "soar-bounded";
        case BenchMethod::soar_incremental:
            return setting.morph ? "soar-incremental, morph" : "soar-incremental";
        case BenchMethod::lstr:
            return setting.morph ? "lstr, morph" : "lstr";
        case BenchMethod::textbook:
        case BenchMethod::full:
            break;
    }
    return to_string(setting.method);
}

}  // namespace relevo::viewer
