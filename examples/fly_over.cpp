// From an elevation file to pictures of a short flight, with the library alone: the LSTR's two halves,
// generating and viewing, with no window.
//
//     fly_over DEM FOLDER [PICTURES]
//
// writes FOLDER/dem.relevo and FOLDER/flight-01.png, ... Without a display it draws in software.

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <ingest/lstr_generator.hpp>
#include <lod/measure/height_sampler.hpp>
#include <viewer/camera.hpp>
#include <viewer/flight/default_flight.hpp>
#include <viewer/gl/gl_context_egl.hpp>
#include <viewer/lstr_viewer.hpp>
#include <viewer/picture.hpp>

namespace fs = std::filesystem;

namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 360;

relevo::Result<void> generate(const fs::path& dem, const fs::path& scene) {
    const auto generator = relevo::ingest::LstrGenerator::load_height_map(dem, scene);
    if (!generator) return generator.error();

    // What the reference's filter would leave out. It is told here and not used: generate() asks it itself.
    const auto removable = generator->simplify(0.1);
    if (!removable) return removable.error();
    const auto& grid = generator->scene().info().frame;
    int removed = 0;
    for (int row = 0; row < grid.rows; ++row) removable->for_each_in_row(row, [&](int) { ++removed; });
    std::printf("%d x %d posts, of which the filter finds %d\n", grid.columns, grid.rows, removed);

    return generator->generate();
}

relevo::Result<void> fly(const fs::path& scene, const fs::path& folder, int pictures) {
    using namespace relevo::viewer;
    const auto context = OffscreenContext::create();
    if (!context) return context.error();

    ViewState view;
    view.layer = Layer::terrain;
    auto viewer = LstrViewer::load(scene, {.look = draw_settings(view), .waits = true});
    if (!viewer) return viewer.error();
    const auto target = RenderTarget::create(kWidth, kHeight, 4);
    if (!target) return target.error();

    relevo::lod::HeightSampler ground(viewer->scene());
    const auto flight = default_flight(ground);
    if (!flight) return flight.error();

    const double step_s = flight->duration_s() / pictures;
    for (int i = 0; i < pictures; ++i) {
        put(view, flight->at(flight->begin_s() + i * step_s));
        const double elapsed_s = i == 0 ? 0 : step_s;
        if (auto done = viewer->update(camera_of(view, viewer->heights(), kWidth, kHeight), elapsed_s); !done)
            return done;
        if (auto drawn = viewer->draw(*target, elapsed_s); !drawn) return drawn.error();

        Picture picture(kWidth, kHeight);
        target->read_into(picture, 0, 0);
        char name[32];
        std::snprintf(name, sizeof name, "flight-%02d.png", i + 1);
        if (auto done = write_picture(picture, folder / name, {to_string(view)}); !done) return done;
        std::printf("%s: %llu triangles\n", name,
                    static_cast<unsigned long long>(viewer->figures().triangles));
    }
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    const int pictures = argc == 4 ? std::atoi(argv[3]) : 6;
    if (argc < 3 || argc > 4 || pictures < 1 || pictures > 99) {
        std::fputs("usage: fly_over DEM FOLDER [PICTURES, 1 to 99]\n", stderr);
        return 2;
    }
    const fs::path folder = argv[2];
    const fs::path scene = folder / "dem.relevo";
    std::error_code failed;
    fs::create_directories(folder, failed);
    auto done = generate(argv[1], scene);
    if (done) done = fly(scene, folder, pictures);
    if (!done) std::fprintf(stderr, "fly_over: %s\n", done.error().message.c_str());
    return done ? 0 : 1;
}
