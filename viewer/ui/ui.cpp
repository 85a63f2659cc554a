#define GLFW_INCLUDE_NONE  // keys alone
#include "viewer/ui/ui.hpp"

#include <algorithm>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "viewer/ui/font.hpp"

namespace relevo::viewer {

Ui::Ui(std::unique_ptr<int, Release> started) : started_(std::move(started)) {}

// Counts what has to be undone: 1 the context, 2 the window's part, 3 OpenGL's part.
void Ui::Release::operator()(int* started) const {
    if (*started >= 3) ImGui_ImplOpenGL3_Shutdown();
    if (*started >= 2) ImGui_ImplGlfw_Shutdown();
    if (*started >= 1) ImGui::DestroyContext();
    delete started;
}

Result<Ui> Ui::create(const Window& window) {
    std::unique_ptr<int, Release> started(new int(0));
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    *started = 1;
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // leaves nothing behind in the current folder
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    if (!ImGui_ImplGlfw_InitForOpenGL(window.handle(), true)) {
        return Error{ErrorKind::internal, "the user interface cannot be attached to the window"};
    }
    *started = 2;
    if (!ImGui_ImplOpenGL3_Init("#version 450 core")) {
        return Error{ErrorKind::internal, "the user interface cannot draw with this OpenGL"};
    }
    *started = 3;
    return Ui(std::move(started));
}

void Ui::set_look(double scale, bool light) {
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    add_font(*io.Fonts, static_cast<float>(scale));
    if (begun_) {  // else the first frame makes it
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        ImGui_ImplOpenGL3_CreateFontsTexture();
    }
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    style.WindowRounding = 4;
    style.FrameRounding = 3;
    style.WindowBorderSize = 0;
    if (light) {
        ImGui::StyleColorsLight(&style);
        style.Colors[ImGuiCol_WindowBg] = ImVec4(0.96f, 0.96f, 0.97f, 0.88f);
        style.Colors[ImGuiCol_TextDisabled] = ImVec4(0.36f, 0.37f, 0.40f, 1);
    } else {
        ImGui::StyleColorsDark(&style);
        style.Colors[ImGuiCol_WindowBg] = ImVec4(0.05f, 0.06f, 0.08f, 0.84f);
        style.Colors[ImGuiCol_TextDisabled] = ImVec4(0.68f, 0.70f, 0.74f, 1);
    }
    style.ScaleAllSizes(static_cast<float>(scale));
}

bool Ui::has_mouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}
bool Ui::has_keys() const {
    return ImGui::GetIO().WantTextInput;
}

bool Ui::entered() const {
    return enter_pressed_ && ImGui::IsItemActive();
}

void Ui::begin(const Input& input) {
    begun_ = true;
    enter_pressed_ = std::any_of(input.pressed.begin(), input.pressed.end(), [](const Input::Key& key) {
        return key.number == GLFW_KEY_ENTER || key.number == GLFW_KEY_KP_ENTER;
    });
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Ui::end() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace relevo::viewer
