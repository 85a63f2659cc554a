#include "viewer/ui/desk.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

namespace relevo::viewer {

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::seconds kMessageTime{6};

bool may_be_elevation(const std::vector<FileUse>& uses) {
    return std::find(uses.begin(), uses.end(), FileUse::elevation) != uses.end();
}

}  // namespace

std::optional<fs::path> scene_at(const fs::path& path) {
    std::error_code failed;
    for (const fs::path& folder : {path, path.parent_path()}) {
        if (fs::is_regular_file(folder / "scene.json", failed)) return folder;
    }
    return std::nullopt;
}

Desk::Desk(Window window, Ui ui, Settings settings, const DeskOptions& options)
    : window_(std::move(window)), ui_(std::move(ui)), settings_(std::move(settings)), options_(options) {}

Result<Desk> Desk::create(const DeskOptions& options) {
    auto window = Window::create(options.width, options.height, "Relevo");
    if (!window) return window.error();
    auto ui = Ui::create(*window);
    if (!ui) return ui.error();
    LoadedSettings loaded = load_settings(options.settings);
    Desk desk(*std::move(window), *std::move(ui), std::move(loaded.settings), options);
    if (!loaded.complaint.empty()) desk.tell(std::move(loaded.complaint));
    constexpr int kRoomForPanel = 900;
    desk.panel_shown_ = desk.settings_.panel_shown && options.width >= kRoomForPanel;
    return desk;
}

void Desk::apply_look() {
    double scale = options_.ui_scale;
    if (scale == 0) scale = settings_.ui_scale;
    if (scale == 0) scale = window_.scale();
    ui_.set_look(scale, settings_.light);
}

void Desk::begin(const Input& input) {
    if (std::exchange(look_changed_, false)) apply_look();
    window_.set_typing(ui_.has_keys());
    ui_.begin(input);
}

void Desk::open(const fs::path& path) {
    std::error_code failed;
    const fs::path whole = fs::absolute(path, failed).lexically_normal();
    if (const auto scene = scene_at(whole)) {
        next_ = *scene;
    } else if (!fs::exists(whole, failed)) {
        tell(fmt::format("{}: there is no such file", path.string()));
    } else if (import_) {
        tell(fmt::format("{} is being imported; one at a time", import_->file().filename().string()));
    } else if (options_.uses_of && !may_be_elevation(options_.uses_of(whole))) {
        tell(fmt::format("{} has no heights: open a scene first, and then put it over that",
                         path.filename().string()));
    } else {
        import_ = std::make_unique<BackgroundImport>(whole, options_.make_scene);
    }
}

void Desk::see_to_import() {
    if (!import_) return;
    const auto result = import_->result();
    if (!result) return;
    if (*result) {
        next_ = **result;
    } else {
        tell(import_->cancelled()
                 ? fmt::format("{}: the import was cancelled", import_->file().filename().string())
                 : result->error().message);
    }
    import_.reset();
}

void Desk::tell(std::string message) {
    message_ = std::move(message);
    message_since_ = std::chrono::steady_clock::now();
}

bool Desk::message_expired() {
    if (message_.empty() || std::chrono::steady_clock::now() - message_since_ < kMessageTime) return false;
    message_.clear();
    return true;
}

void Desk::draw_import() {
    if (!import_) return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float letter = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({0.5f * size.x, size.y - 4 * letter}, ImGuiCond_Always, {0.5f, 1});
    ImGui::Begin("import", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::Text("importing %s", import_->file().filename().string().c_str());
    const auto done = static_cast<float>(import_->progress());
    ImGui::ProgressBar(done, {20 * letter, 0}, fmt::format("{:.0f} %", 100 * done).c_str());
    ImGui::SameLine();
    if (ImGui::Button(import_->cancelled() ? "stopping" : "cancel")) import_->cancel();
    ImGui::End();
}

void Desk::save() {
    if (options_.settings.empty()) return;
    if (auto done = save_settings(settings_, options_.settings); !done) tell(done.error().message);
}

}  // namespace relevo::viewer
