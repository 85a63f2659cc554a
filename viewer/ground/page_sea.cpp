#include "viewer/ground/page_sea.hpp"

namespace relevo::viewer {

PageSea page_sea(const std::vector<std::uint8_t>& is_sea) {
    PageSea sea;
    if (is_sea.empty()) {
        sea.parts.fill({false, true});
        sea.all = {false, true};
        return sea;
    }
    for (int part_row = 0; part_row < PageSea::kParts; ++part_row) {
        for (int part_column = 0; part_column < PageSea::kParts; ++part_column) {
            PageSea::Part& part =
                sea.parts[static_cast<std::size_t>(part_row * PageSea::kParts + part_column)];
            for (int row = 0; row <= PageSea::kPartCells; ++row) {
                const std::uint8_t* post = is_sea.data() +
                                           (part_row * PageSea::kPartCells + row) * kPagePosts +
                                           part_column * PageSea::kPartCells;
                for (int column = 0; column <= PageSea::kPartCells; ++column) {
                    part.sea = part.sea || post[column] != 0;
                    part.land = part.land || post[column] == 0;
                }
            }
            sea.all = {sea.all.sea || part.sea, sea.all.land || part.land};
        }
    }
    return sea;
}

}  // namespace relevo::viewer
