#include "viewer/ui/number_box.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "viewer/numbers.hpp"

namespace relevo::viewer {

bool NumberBox::draw(const Ui& ui, const char* label, double& value, double least, double most) {
    const unsigned box = ImGui::GetID(label);
    std::string text = typed_in_ == box ? text_ : fmt::format("{}", value);
    ImGui::SetNextItemWidth(6 * ImGui::GetFontSize());
    ImGui::InputText(label, &text, ImGuiInputTextFlags_CharsScientific | ImGuiInputTextFlags_AutoSelectAll);
    if (ImGui::IsItemActive()) {
        typed_in_ = box;
        text_ = text;
    } else if (typed_in_ == box) {
        typed_in_ = 0;
    }
    const bool entered = ui.entered();
    if (!ImGui::IsItemDeactivatedAfterEdit() && !entered) return false;
    if (entered) {  // keys are commands again, also where Dear ImGui has not seen this one
        ImGui::SetWindowFocus(nullptr);
        typed_in_ = 0;
    }
    const auto numbers = parse_numbers(text);
    if (!numbers || numbers->size() != 1) return false;  // as it was
    const double typed = std::clamp(numbers->front(), least, most);
    if (typed == value) return false;
    value = typed;
    return true;
}

}  // namespace relevo::viewer
