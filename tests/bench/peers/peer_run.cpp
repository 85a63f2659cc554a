#include "tests/bench/peers/peer_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>
#include <sys/resource.h>

namespace relevo::peers {

namespace {

const auto kStart = std::chrono::steady_clock::now();

double peak_mib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

std::string measured(const PeerOptions& options, const PeerProgram& program) {
    PixelErrors all;
    double sum2 = 0;
    for (int k = 0; k < options.error_frames; ++k) {
        const PixelErrors one = program.errors((k + 0.5) / options.error_frames);
        all.max_px = std::max(all.max_px, one.max_px);
        all.p99_px = std::max(all.p99_px, one.p99_px);
        all.oracle_max_px = std::max(all.oracle_max_px, one.oracle_max_px);
        sum2 += one.rms_px * one.rms_px;
        all.pixels += one.pixels;
    }
    all.rms_px = std::sqrt(sum2 / options.error_frames);
    return fmt::format(
        R"("error_frames": {}, "max_px": {:.3f}, "p99_px": {:.3f}, "rms_px": {:.4f}, "pixels": {}, "oracle_max_px": {:.3f})",
        options.error_frames, all.max_px, all.p99_px, all.rms_px, all.pixels, all.oracle_max_px);
}

std::string timed(const PeerOptions& options, const PeerProgram& program) {
    constexpr int kWarming = 10;  // programs are compiled, buffers grow
    for (int k = 0; k < kWarming; ++k) program.frame(static_cast<double>(k) / kWarming);
    FrameFigures sum;
    int frames = 0;
    const double start = seconds();
    double took = 0;
    // The path as often as it takes for a figure that another run repeats.
    for (constexpr double kEnough = 1; took < kEnough; took = seconds() - start) {
        for (int k = 0; k < options.frames; ++k, ++frames) {
            const FrameFigures one = program.frame(static_cast<double>(k) / options.frames);
            sum.triangles += one.triangles;
            sum.draws += one.draws;
        }
    }
    return fmt::format(R"("frames": {}, "frames_s": {:.2f}, "triangles": {:.0f}, "draws": {:.1f})", frames,
                       frames / took, sum.triangles / frames, sum.draws / frames);
}

}  // namespace

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - kStart).count();
}

std::optional<PeerOptions> parse_options(int argc, char** argv, const char* usage) {
    PeerOptions options;
    bool good = true;
    for (int i = 1; i < argc; ++i) {
        const std::string_view flag = argv[i];
        const auto value = [&]() -> const char* {
            good = good && i + 1 < argc;
            return good ? argv[++i] : "";
        };
        if (flag == "--size") {
            good = std::sscanf(value(), "%dx%d", &options.width, &options.height) == 2 && good;
        } else if (flag == "--frames") {
            options.frames = std::atoi(value());
        } else if (flag == "--errors") {
            options.error_frames = std::atoi(value());
            good = good && options.error_frames > 0;
        } else if (flag == "--full") {
            options.full = true;
        } else if (flag == "--morph") {
            options.morph = true;
        } else if (flag == "--tau") {
            options.tau_px = std::atof(value());
        } else if (flag == "--lod") {
            options.method = value();
        } else {
            good = good && options.input.empty() && !flag.starts_with('-');
            options.input = flag;
        }
    }
    if (good && !options.input.empty() && options.width > 0 && options.height > 0 && options.frames > 0)
        return options;
    fmt::print(stderr, "usage: {} [--size WxH] [--frames N] [--errors N] [--full]\n", usage);
    return std::nullopt;
}

void run_peer(const PeerOptions& options, const PeerProgram& program, double load_s) {
    const std::string figures =
        options.error_frames > 0 ? measured(options, program) : timed(options, program);
    fmt::print(
        R"({{"program": "{}", "input": "{}", "width": {}, "height": {}, {}, "load_s": {:.2f}, "peak_mib": {:.0f}}})"
        "\n",
        program.name, options.input, options.width, options.height, figures, load_s, peak_mib());
}

}  // namespace relevo::peers
