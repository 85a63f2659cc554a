#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "tests/viewer/studio.hpp"
#include "viewer/gl/gl_check.hpp"
#include "viewer/gl/gl_program.hpp"
#include "viewer/offscreen.hpp"

namespace relevo::test {
namespace {

TEST(GlFailure, AShaderThatDoesNotCompileSaysWhy) {
    const auto context = must(viewer::OffscreenContext::create());
    const auto program = viewer::build_program({.name = "broken",
                                                .defines = {},
                                                .common = {},
                                                .vertex = "void main() { gl_Position = nothing; }\n",
                                                .geometry = {},
                                                .fragment = "void main() {}\n"});
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().kind, ErrorKind::internal);
    EXPECT_NE(program.error().message.find("broken"), std::string::npos);
    EXPECT_NE(program.error().message.find("nothing"), std::string::npos) << program.error().message;
}

TEST(GlFailure, ErrorsAreReportedOnceWithTheirText) {
    const auto context = must(viewer::OffscreenContext::create());
    EXPECT_TRUE(viewer::gl_check("doing nothing"));
    glBindTexture(GL_LINEAR, 1);
    const auto failed = viewer::gl_check("binding nonsense");
    ASSERT_FALSE(failed);
    EXPECT_NE(failed.error().message.find("binding nonsense"), std::string::npos);
    EXPECT_TRUE(viewer::gl_check("doing nothing again"));
}

TEST(GlFailure, GroundThatMustShowIsKnownFromTheFullData) {
    const auto frame = geographic_frame(65, 65);
    const auto terrain = make_terrain(frame, make_heights(frame, [](int, int) { return 10.0; }));
    lod::Camera camera = above_looking_down(terrain, 32, 32, 500);
    EXPECT_TRUE(viewer::ground_must_show(terrain, lod::View(camera), {}));
    camera.pitch.value = 90;
    EXPECT_FALSE(viewer::ground_must_show(terrain, lod::View(camera), {}));
}

}  // namespace
}  // namespace relevo::test
