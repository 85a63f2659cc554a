// Ogre's terrain on the path that all of these programs fly, with batches of its usual size and a bound on
// its error in pixels, lit at the vertices, morphing as it does.
//
//   ogre_peer HEIGHTS.f32 [--tau MAX_PIXEL_ERROR] [--size WxH] [--frames N] [--errors N] [--full]

#include <cmath>
#include <memory>

#include <OGRE/Ogre.h>
#include <OGRE/Terrain/OgreTerrain.h>
#include <OGRE/Terrain/OgreTerrainMaterialGenerator.h>
#include <fmt/format.h>

#include "tests/bench/peers/depth_picture.hpp"
#include "tests/bench/peers/peer_run.hpp"

namespace {

using namespace relevo::peers;

/// The engine's world: x east, y up, z south.
Ogre::Vector3 in_engine(const Place& place) {
    return {static_cast<float>(place.x), static_cast<float>(place.z), static_cast<float>(-place.y)};
}

// The engine keeps normals in a texture. Vertices of a level that is about to go sink to where the next one
// is.
constexpr const char* kVertex = R"(#version 120
uniform mat4 to_clip;
uniform vec2 morph;
uniform vec3 to_sun;
uniform sampler2D normals;
attribute vec4 vertex;
attribute vec2 uv0;
attribute vec2 uv1;
varying vec3 lit;
void main() {
    float sinks = -min(0.0, sign(uv1.y - morph.y));
    vec4 place = vertex;
    place.y += uv1.x * sinks * morph.x;
    gl_Position = to_clip * place;
    vec3 normal = texture2DLod(normals, uv0, 0.0).xyz * 2.0 - 1.0;
    lit = vec3(0.72, 0.68, 0.60) * (0.4 + 0.75 * max(dot(normal, to_sun), 0.0));
}
)";
constexpr const char* kFragment = R"(#version 120
varying vec3 lit;
void main() { gl_FragColor = vec4(lit, 1.0); }
)";

class VertexLit : public Ogre::TerrainMaterialGenerator::Profile {
  public:
    explicit VertexLit(Ogre::TerrainMaterialGenerator* parent) : Profile(parent, "vertex-lit", "") {}

    bool isVertexCompressionSupported() const override { return false; }
    Ogre::MaterialPtr generate(const Ogre::Terrain* terrain) override {
        auto& materials = Ogre::MaterialManager::getSingleton();
        const Ogre::String& name = terrain->getMaterialName();
        if (auto known = materials.getByName(name)) return known;
        auto made = materials.create(name, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
        auto* pass = made->getTechnique(0)->getPass(0);
        pass->setLightingEnabled(false);
        pass->setVertexProgram(program("lit_vertex", kVertex, Ogre::GPT_VERTEX_PROGRAM));
        pass->setFragmentProgram(program("lit_fragment", kFragment, Ogre::GPT_FRAGMENT_PROGRAM));
        auto* texture = pass->createTextureUnitState();
        texture->setTexture(terrain->getTerrainNormalMap());
        texture->setTextureAddressingMode(Ogre::TAM_CLAMP);
        texture->setTextureFiltering(Ogre::FO_POINT, Ogre::FO_POINT, Ogre::FO_NONE);
        auto values = pass->getVertexProgramParameters();
        values->setNamedAutoConstant("to_clip", Ogre::GpuProgramParameters::ACT_WORLDVIEWPROJ_MATRIX);
        values->setNamedAutoConstant("morph", Ogre::GpuProgramParameters::ACT_CUSTOM,
                                     Ogre::Terrain::LOD_MORPH_CUSTOM_PARAM);
        values->setNamedConstant("to_sun", in_engine(kToSun));
        values->setNamedConstant("normals", 0);
        return made;
    }
    Ogre::MaterialPtr generateForCompositeMap(const Ogre::Terrain*) override { return {}; }
    void setLightmapEnabled(bool) override {}
    Ogre::uint8 getMaxLayers(const Ogre::Terrain*) const override { return 0; }
    void updateParams(const Ogre::MaterialPtr&, const Ogre::Terrain*) override {}
    void updateParamsForCompositeMap(const Ogre::MaterialPtr&, const Ogre::Terrain*) override {}
    void requestOptions(Ogre::Terrain* terrain) override {
        terrain->_setMorphRequired(true);
        terrain->_setNormalMapRequired(true);
        terrain->_setLightMapRequired(false);
        terrain->_setCompositeMapRequired(false);
    }

  private:
    static Ogre::String program(const char* name, const char* text, Ogre::GpuProgramType type) {
        auto made = Ogre::HighLevelGpuProgramManager::getSingleton().createProgram(
            name, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME, "glsl", type);
        made->setSource(text);
        made->load();
        return name;
    }
};

class VertexLitGenerator : public Ogre::TerrainMaterialGenerator {
  public:
    VertexLitGenerator() {
        mProfiles.push_back(OGRE_NEW VertexLit(this));
        setActiveProfile(mProfiles.back());
    }
};

Ogre::RenderWindow* open_window(Ogre::Root& root, const PeerOptions& options) {
    root.loadPlugin(OGRE_PLUGINS "/RenderSystem_GL");
    root.setRenderSystem(root.getAvailableRenderers().front());
    root.initialise(false);
    const Ogre::NameValuePairList how{{"vsync", "No"}, {"FSAA", "0"}};
    return root.createRenderWindow("ogre_peer", static_cast<unsigned>(options.width),
                                   static_cast<unsigned>(options.height), false, &how);
}

void load(Ogre::Root& root, Ogre::Terrain& terrain, const Heights& heights) {
    // Rows from the south.
    std::vector<float> samples;
    samples.reserve(heights.samples.size());
    for (int row = heights.posts - 1; row >= 0; --row)
        for (int column = 0; column < heights.posts; ++column) samples.push_back(heights.at(column, row));
    Ogre::Terrain::ImportData data;
    data.terrainSize = static_cast<Ogre::uint16>(heights.posts);
    data.maxBatchSize = 65;
    data.minBatchSize = 17;
    data.worldSize = static_cast<float>(kSideM);
    data.inputFloat = samples.data();
    if (!terrain.prepare(data)) throw std::runtime_error("Ogre cannot prepare the terrain");
    terrain.load(0, true);
    while (terrain.isDerivedDataUpdateInProgress()) root.getWorkQueue()->processResponses();
}

int fly(const PeerOptions& options, const Heights& heights) {
    const double near = options.error_frames > 0 ? kNearForErrorsM : kNearM;
    Ogre::LogManager logs;
    logs.createLog("ogre_peer", true, false, true);
    Ogre::Root root("", "", "");
    Ogre::RenderWindow* window = open_window(root, options);
    Ogre::ResourceGroupManager::getSingleton().initialiseAllResourceGroups();
    Ogre::SceneManager* scene = root.createSceneManager();
    Ogre::Camera* camera = scene->createCamera("eye");
    camera->setFOVy(Ogre::Degree(static_cast<float>(kFovDegrees)));
    camera->setAspectRatio(static_cast<float>(options.width) / static_cast<float>(options.height));
    camera->setNearClipDistance(static_cast<float>(near));
    camera->setFarClipDistance(static_cast<float>(kFarM));
    Ogre::SceneNode* node = scene->getRootSceneNode()->createChildSceneNode();
    node->attachObject(camera);
    node->pitch(Ogre::Degree(static_cast<float>(kPitchDegrees)));
    window->addViewport(camera)->setBackgroundColour(Ogre::ColourValue(0.70F, 0.80F, 0.90F));

    const double start = seconds();
    Ogre::TerrainGlobalOptions settings;
    settings.setMaxPixelError(options.full ? 0.0F : static_cast<float>(options.tau_px));
    settings.setDefaultMaterialGenerator(Ogre::TerrainMaterialGeneratorPtr(OGRE_NEW VertexLitGenerator));
    const auto terrain = std::make_unique<Ogre::Terrain>(scene);
    load(root, *terrain, heights);

    const auto draw = [&](double part) {
        node->setPosition(in_engine(eye_at(part)));
        root._fireFrameStarted();
        window->update(false);
    };
    const auto show = [&] {
        window->swapBuffers();
        root._fireFrameEnded();
    };
    const PeerProgram program{
        fmt::format("ogre {}", options.full ? 0 : options.tau_px),
        [&](double part) -> FrameFigures {
            draw(part);
            const auto& figures = window->getStatistics();
            show();
            return {static_cast<double>(figures.triangleCount), static_cast<double>(figures.batchCount)};
        },
        [&](double part) {
            draw(part);
            const auto depth = read_depth(options.width, options.height, near, kFarM, false);
            show();
            return measure(heights, eye_at(part), options.width, options.height, depth);
        }};
    program.frame(0);
    run_peer(options, program, seconds() - start);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const auto options = parse_options(argc, argv, "ogre_peer HEIGHTS.f32 [--tau MAX_PIXEL_ERROR]");
    if (!options) return 2;
    const Heights heights = read_heights(options->input);
    if (heights.posts == 0) {
        fmt::print(stderr, "{}: cannot be read, or is not a square of floats\n", options->input);
        return 3;
    }
    try {
        return fly(*options, heights);
    } catch (const std::exception& failure) {
        fmt::print(stderr, "{}: {}\n", options->input, failure.what());
        return 5;
    }
}
