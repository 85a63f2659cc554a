#pragma once

#include <functional>
#include <optional>
#include <string>

#include "tests/bench/peers/surface_error.hpp"

namespace relevo::peers {

struct PeerOptions {
    std::string input;  ///< heights or a scene
    int width = 1280;
    int height = 720;
    int frames = 300;
    int error_frames = 0;  ///< measured instead of timed
    bool full = false;     ///< every triangle: what reading back adds to errors
    double tau_px = 1;     ///< or the engine's own bound
    bool morph = false;    ///< relevo alone; Ogre always does
    std::string method = "soar";
};

/// Nothing where the arguments are wrong; then says how they should be. \param usage  of the program's own
std::optional<PeerOptions> parse_options(int argc, char** argv, const char* usage);

struct FrameFigures {
    double triangles = 0;
    double draws = 0;
};

/// What a program does at a part of the path, 0 to 1.
struct PeerProgram {
    std::string name;
    std::function<FrameFigures(double part)> frame;  ///< draws and shows
    std::function<PixelErrors(double part)> errors;  ///< draws and measures
};

/// Flies, measures as asked and prints one JSON object. \param load_s  until the terrain was ready
void run_peer(const PeerOptions& options, const PeerProgram& program, double load_s);

/// Seconds since the program was started.
double seconds();

}  // namespace relevo::peers
