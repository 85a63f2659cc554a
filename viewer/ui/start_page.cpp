#define GLFW_INCLUDE_NONE  // epoxy declares OpenGL
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include "viewer/ui/desk.hpp"
#include "viewer/ui/file_chooser.hpp"

namespace relevo::viewer {

namespace fs = std::filesystem;

namespace {

void draw_page(Desk& desk, FileChooser& chooser) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float letter = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({0.5f * size.x, 0.4f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::Begin(
        "start", nullptr,
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
    ImGui::TextUnformatted("Relevo");
    ImGui::TextDisabled("Drop a scene or an elevation file here.");
    if (ImGui::Button("Open... (Ctrl O)")) chooser.show();
    if (!desk.settings().recent.empty()) {
        ImGui::Separator();
        ImGui::TextDisabled("Recent scenes");
        const std::vector<std::string> recent = desk.settings().recent;
        for (const std::string& scene : recent) {
            std::error_code failed;
            if (fs::exists(fs::path(scene) / "scene.json", failed)) {
                if (ImGui::Selectable(scene.c_str(), false, 0, {30 * letter, 0})) desk.open(scene);
            } else {
                ImGui::TextDisabled("%s   is no longer there", scene.c_str());
            }
        }
    }
    if (!desk.message().empty()) {
        ImGui::Separator();
        ImGui::PushTextWrapPos(32 * letter);
        ImGui::TextUnformatted(desk.message().c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
    desk.draw_import();
    if (const auto chosen = chooser.draw(desk.ui())) desk.open(*chosen);
}

}  // namespace

Result<std::optional<fs::path>> choose_scene(Desk& desk) {
    Window& window = desk.window();
    FileChooser chooser;
    for (int frames = 0; !window.should_close(); ++frames) {
        const Input& input = window.poll(desk.import() != nullptr || frames < 3 ? 0.05 : 0.5);
        for (const std::string& path : input.dropped) desk.open(path);
        for (const Input::Key& key : input.pressed) {
            if (key.control && key.number == GLFW_KEY_O) chooser.show();
            if (key.control && key.number == GLFW_KEY_Q) window.close();
        }
        desk.see_to_import();
        if (desk.has_next()) return std::optional(desk.take_next());
        const glm::ivec2 size = window.size();
        if (size.x <= 0 || size.y <= 0) continue;
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glViewport(0, 0, size.x, size.y);
        glClearColor(0.16f, 0.20f, 0.26f, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        desk.begin(input);
        draw_page(desk, chooser);
        desk.end();
        window.show();
    }
    return std::optional<fs::path>();
}

}  // namespace relevo::viewer
