#include "lod/lstr/border_line.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include <glm/geometric.hpp>

namespace relevo::lod {

std::vector<bool> border_line(const PostField& field, const std::vector<const PlacedPost*>& finer,
                              double error_m) {
    std::vector<bool> kept(finer.size());
    kept.front() = kept.back() = true;
    const GridPoint& from = finer.front()->at;
    const bool along_row = from.row == finer.back()->at.row;
    const auto place = [&](const PlacedPost& post) {
        return along_row ? post.at.column - from.column : post.at.row - from.row;
    };
    std::vector<PlacedPost> judges;  // the field's valid posts on the side
    std::vector<int> places;
    for (int at = 0; at <= place(*finer.back()); at += field.stride()) {
        const GridPoint post =
            along_row ? GridPoint{from.column + at, from.row} : GridPoint{from.column, from.row + at};
        if (!field.is_valid(post)) continue;
        judges.push_back(field.post(post));
        places.push_back(at);
    }
    // The farthest post off the straight line between two that are kept; no finer one between: nothing to do.
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, finer.size() - 1}};
    const auto middle = static_cast<std::size_t>(
        std::find_if(finer.begin(), finer.end(),
                     [&](const PlacedPost* post) { return 2 * place(*post) == place(*finer.back()); }) -
        finer.begin());
    if (middle < finer.size()) {
        kept[middle] = true;
        open = {{0, middle}, {middle, finer.size() - 1}};
    }
    while (!open.empty()) {
        const auto [first, last] = open.back();
        open.pop_back();
        if (last - first < 2) continue;
        const int begin = place(*finer[first]);
        const int end = place(*finer[last]);
        double worst = error_m;
        int worst_place = -1;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (places[i] <= begin || places[i] >= end) continue;
            const double part = static_cast<double>(places[i] - begin) / (end - begin);
            const double off = glm::distance(
                judges[i].position, (1 - part) * finer[first]->position + part * finer[last]->position);
            if (off <= worst) continue;
            worst = off;
            worst_place = places[i];
        }
        if (worst_place < 0) continue;
        std::size_t split = first + 1;
        for (std::size_t i = first + 1; i < last; ++i) {
            if (std::abs(place(*finer[i]) - worst_place) < std::abs(place(*finer[split]) - worst_place))
                split = i;
        }
        kept[split] = true;
        open.emplace_back(first, split);
        open.emplace_back(split, last);
    }
    return kept;
}

}  // namespace relevo::lod
