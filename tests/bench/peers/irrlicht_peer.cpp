// Irrlicht's terrain node on the path that all of these programs fly: its standard patches of 17 x 17 posts
// with 5 levels of detail, lit at the vertices.
//
//   irrlicht_peer HEIGHTS.f32 [--size WxH] [--frames N] [--errors N] [--full]

#include <cmath>

#include <fmt/format.h>
#include <irrlicht.h>

#include "tests/bench/peers/depth_picture.hpp"
#include "tests/bench/peers/peer_run.hpp"

namespace {

using namespace relevo::peers;
using irr::core::vector3df;

/// The engine's world is left-handed: x east, y up, z north.
vector3df in_engine(const Place& place) {
    return {static_cast<float>(place.x), static_cast<float>(place.z), static_cast<float>(place.y)};
}

/// As the engine reads a raw file: columns of the map one after another, from the west, each from the south.
std::vector<float> columns_from_south(const Heights& heights) {
    std::vector<float> samples;
    samples.reserve(heights.samples.size());
    for (int column = 0; column < heights.posts; ++column)
        for (int row = heights.posts - 1; row >= 0; --row) samples.push_back(heights.at(column, row));
    return samples;
}

irr::IrrlichtDevice* open_window(const PeerOptions& options) {
    irr::SIrrlichtCreationParameters parameters;
    parameters.DriverType = irr::video::EDT_OPENGL;
    parameters.WindowSize = {static_cast<irr::u32>(options.width), static_cast<irr::u32>(options.height)};
    parameters.Bits = 32;
    parameters.ZBufferBits = 24;
    parameters.Vsync = false;
    parameters.LoggingLevel = irr::ELL_ERROR;
    return irr::createDeviceEx(parameters);
}

irr::scene::ITerrainSceneNode* add_terrain(irr::IrrlichtDevice& device, const Heights& heights, bool full) {
    auto* scene = device.getSceneManager();
    const auto side = static_cast<float>(kSideM);
    const auto spacing = static_cast<float>(heights.spacing_m());
    auto* terrain = scene->addTerrainSceneNode(irr::io::path(), nullptr, -1, {-side / 2, 0, -side / 2}, {},
                                               {spacing, 1, spacing}, {255, 255, 255, 255}, 5,
                                               irr::scene::ETPS_17, 0, true);
    const std::vector<float> samples = columns_from_south(heights);
    auto* file = device.getFileSystem()->createMemoryReadFile(
        const_cast<float*>(samples.data()), static_cast<irr::s32>(samples.size() * sizeof(float)), "heights");
    const bool loaded = terrain->loadHeightMapRAW(file, 32, true, true, heights.posts);
    file->drop();
    if (!loaded) return nullptr;
    if (full) {
        for (irr::s32 level = 0; level < 5; ++level) terrain->overrideLODDistance(level, 1e30 + level);
    }
    terrain->setMaterialFlag(irr::video::EMF_LIGHTING, true);
    terrain->setMaterialFlag(irr::video::EMF_NORMALIZE_NORMALS, true);
    terrain->setMaterialFlag(irr::video::EMF_FOG_ENABLE, false);
    return terrain;
}

void add_light(irr::scene::ISceneManager& scene) {
    scene.setAmbientLight({0.4F, 0.4F, 0.4F, 1});
    auto* light = scene.addLightSceneNode(nullptr, {}, {0.75F, 0.72F, 0.65F, 1});
    light->setLightType(irr::video::ELT_DIRECTIONAL);
    // A directional light shines along its own z.
    light->setRotation((-in_engine(kToSun)).getHorizontalAngle());
}

}  // namespace

int main(int argc, char** argv) {
    const auto options = parse_options(argc, argv, "irrlicht_peer HEIGHTS.f32");
    if (!options) return 2;
    const Heights heights = read_heights(options->input);
    if (heights.posts == 0) {
        fmt::print(stderr, "{}: cannot be read, or is not a square of floats\n", options->input);
        return 3;
    }
    irr::IrrlichtDevice* device = open_window(*options);
    if (device == nullptr) return 4;
    const double start = seconds();
    auto* terrain = add_terrain(*device, heights, options->full);
    if (terrain == nullptr) {
        fmt::print(stderr, "{}: Irrlicht cannot load it\n", options->input);
        return 5;
    }
    auto* driver = device->getVideoDriver();
    auto* scene = device->getSceneManager();
    add_light(*scene);
    const double near = options->error_frames > 0 ? kNearForErrorsM : kNearM;
    auto* camera = scene->addCameraSceneNode();
    camera->setFOV(static_cast<float>(radians(kFovDegrees)));
    camera->setAspectRatio(static_cast<float>(options->width) / static_cast<float>(options->height));
    camera->setNearValue(static_cast<float>(near));
    camera->setFarValue(static_cast<float>(kFarM));

    const auto draw = [&](double part) {
        device->run();
        const Place eye = eye_at(part);
        camera->setPosition(in_engine(eye));
        camera->setTarget(in_engine({eye.x, eye.y + 1e4 * std::cos(radians(kPitchDegrees)),
                                     eye.z + 1e4 * std::sin(radians(kPitchDegrees))}));
        driver->beginScene(true, true, {255, 178, 204, 229});
        scene->drawAll();
    };
    const PeerProgram program{
        "irrlicht",
        [&](double part) -> FrameFigures {
            draw(part);
            const double triangles = driver->getPrimitiveCountDrawn();
            driver->endScene();
            return {triangles, 1};
        },
        [&](double part) {
            draw(part);
            const auto depth = read_depth(options->width, options->height, near, kFarM, true);
            driver->endScene();
            return measure(heights, eye_at(part), options->width, options->height, depth);
        }};
    program.frame(0);
    run_peer(*options, program, seconds() - start);
    device->drop();
    return 0;
}
