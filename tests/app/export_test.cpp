// `relevo export` as people and scripts use it.

#include <string>

#include <nlohmann/json.hpp>

#include "tests/app/run_program.hpp"
#include "tests/lod/scratch_scene.hpp"
#include "tests/output/mesh_files.hpp"

namespace relevo::test {
namespace {

class Export : public testing::Test {
  protected:
    void SetUp() override {
        const auto written = write_scene(made_up_scene(600, 300), folder / "a.relevo");
        ASSERT_TRUE(written) << written.error().message;
    }
    test::Run run(const std::string& arguments) const { return relevo("export " + scene() + arguments); }
    std::string scene() const { return "'" + (folder / "a.relevo").string() + "' "; }
    std::string to(const std::string& name) const { return "-o '" + (folder / name).string() + "' "; }
    /// Files besides the scene.
    int files() const {
        int count = -1;
        for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++count;
        return count;
    }

    SceneFolder folder;
};

TEST_F(Export, MeshesHaveTheContractsKeys) {
    for (const char* const name : {"a.ply", "a.GLB", "a.obj"}) {
        const auto done = run(to(name) + "--max-error 5 --json");
        ASSERT_EQ(done.status, 0) << done.err;
        EXPECT_EQ(done.err, "");
        const auto json = nlohmann::json::parse(done.out, nullptr, false);
        ASSERT_TRUE(json.is_object()) << done.out;
        for (const char* const key :
             {"triangles", "vertices", "max_error_m", "rms_error_m", "seconds", "requested_error_m",
              "vertical_datum", "crs", "bytes", "origin", "scene"})
            EXPECT_TRUE(json.contains(key)) << key;
        EXPECT_GT(json["triangles"].get<int>(), 0);
        EXPECT_LE(json["max_error_m"].get<double>(), 5);
        EXPECT_EQ(json["bytes"], std::filesystem::file_size(folder / name));
        EXPECT_EQ(json["coordinates"], "enu");
    }
    EXPECT_EQ(read_ply(folder / "a.ply").triangles, read_obj(folder / "a.obj").triangles);
    EXPECT_EQ(files(), 3);
}

TEST_F(Export, SameBytesEachTime) {
    ASSERT_EQ(run(to("a.ply") + "--max-error 5").status, 0);
    ASSERT_EQ(run(to("b.ply") + "--max-error 5").status, 0);
    EXPECT_EQ(contents(folder / "a.ply"), contents(folder / "b.ply"));
}

TEST_F(Export, ABoxIsPartOfTheWhole) {
    const auto opened = lod::Scene::open(folder / "a.relevo");
    ASSERT_TRUE(opened);
    const geo::GridFrame& frame = opened->info().frame;
    const double west = frame.west + 100.3 * frame.step_x;
    const double east = frame.west + 150.7 * frame.step_x;
    const double north = frame.north - 30.5 * frame.step_y;
    const double south = frame.north - 60.5 * frame.step_y;
    const auto bounds = fmt::format("--bounds {:.12f},{:.12f},{:.12f},{:.12f} ", west, south, east, north);
    const auto done = run(to("a.ply") + bounds + "--max-error 0 --coordinates geodetic --json");
    ASSERT_EQ(done.status, 0) << done.err;
    const auto json = nlohmann::json::parse(done.out);
    EXPECT_EQ(json["columns"], 52);
    EXPECT_EQ(json["rows"], 32);
    EXPECT_NEAR(json["extent"]["west"].get<double>(), frame.west + 100 * frame.step_x, 1e-9);
    for (const auto& vertex : read_ply(folder / "a.ply").vertices) {
        EXPECT_GE(vertex[0], west - frame.step_x);
        EXPECT_LE(vertex[0], east + frame.step_x);
        EXPECT_GE(vertex[1], south - frame.step_y);
        EXPECT_LE(vertex[1], north + frame.step_y);
    }
    const auto raster = run(to("a.tif") + bounds + "--json");
    ASSERT_EQ(raster.status, 0) << raster.err;
    EXPECT_EQ(nlohmann::json::parse(raster.out)["columns"], 52);
}

TEST_F(Export, OverwritesOnlyWhenAsked) {
    ASSERT_EQ(run(to("a.ply") + "--max-error 0").status, 0);
    const std::string first = contents(folder / "a.ply");
    const auto refused = run(to("a.ply") + "--max-error 50");
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("--overwrite"), std::string::npos) << refused.err;
    EXPECT_EQ(contents(folder / "a.ply"), first);
    ASSERT_EQ(run(to("a.ply") + "--max-error 50 --overwrite").status, 0);
    EXPECT_LT(contents(folder / "a.ply").size(), first.size());
    // Not a scene, or any folder.
    EXPECT_EQ(run("-o '" + (folder / "a.relevo").string() + "' --tif --overwrite").status, 2);
    EXPECT_TRUE(lod::Scene::open(folder / "a.relevo"));
    EXPECT_EQ(files(), 1);
}

TEST_F(Export, RefusesWithStatusAndRemedy) {
    const auto refused = [&](const std::string& arguments, int status, const std::string& word) {
        const auto done = run(arguments);
        EXPECT_EQ(done.status, status) << arguments;
        EXPECT_NE(done.err.find(word), std::string::npos) << done.err;
        EXPECT_EQ(done.out, "");
    };
    refused(to("a.ply"), 2, "--max-error");
    refused(to("a.ply") + "--max-error -1", 2, "--max-error");
    refused(to("a.ply") + "--max-error nan", 2, "--max-error");
    refused(to("a.stl") + "--max-error 1", 2, ".glb");
    refused(to("a.tif") + "--max-error 1", 2, "--max-error");
    refused(to("a.ply") + "--max-error 1 --bounds 0,0,1,1", 2, "--bounds");
    refused(to("a.ply") + "--max-error 1 --memory 1MiB", 2, "--memory");
    refused(to("a.ply") + "--max-error 1 --coordinates moon", 2, "--coordinates");
    refused(to("no/folder/a.ply") + "--max-error 1", 2, "folder");
    EXPECT_EQ(relevo("export '/no/such.relevo' --max-error 1 " + to("a.ply")).status, 3);
    EXPECT_EQ(files(), 0);
}

TEST_F(Export, NoGroundIsAnErrorOfTheInput) {
    SceneParts parts = made_up_scene(9, 9);
    for (float& H : parts.heights.samples()) H = std::nanf("");
    parts.heights.at(4, 4) = 1;
    ASSERT_TRUE(write_scene(parts, folder / "b.relevo"));
    const auto done = relevo("export '" + (folder / "b.relevo").string() + "' --max-error 1 " + to("a.ply"));
    EXPECT_EQ(done.status, 3);
    EXPECT_NE(done.err.find("b.relevo"), std::string::npos) << done.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "a.ply"));
}

TEST_F(Export, DamageIsSaidAndNothingIsWritten) {
    const auto opened = lod::Scene::open(folder / "a.relevo");
    ASSERT_TRUE(opened);
    const auto file = folder / "a.relevo" / opened->info().heights.front().file;
    std::filesystem::permissions(file, std::filesystem::perms::owner_write,
                                 std::filesystem::perm_options::add);
    replace(file, "damaged");
    for (const std::string& name : {std::string("a.ply' --max-error 1"), std::string("a.tif'")}) {
        const auto done = run("-o '" + (folder / "").string() + name);
        EXPECT_EQ(done.status, 4) << done.err;
        EXPECT_NE(done.err.find("a.relevo"), std::string::npos) << done.err;
    }
    EXPECT_EQ(files(), 0);
}

TEST_F(Export, AFullDiskIsAnErrorAndLeavesNothing) {
    for (const std::string& name : {std::string("a.ply' --max-error 0"), std::string("a.tif'")}) {
        const auto done =
            relevo("export " + scene() + "-o '" + (folder / "").string() + name, "ulimit -f 40;");
        EXPECT_EQ(done.status, 1) << done.err;
        EXPECT_NE(done.err.find("rite"), std::string::npos) << done.err;
    }
    EXPECT_EQ(files(), 0);
}

}  // namespace
}  // namespace relevo::test
