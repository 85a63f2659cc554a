// What overlays are drawn with (viewer/overlay/overlay_block.hpp).
layout(std140, binding = 5) uniform Overlays {
    vec4 drawn[8];     // from the lowest: its opacity; of contours lines a unit of a texel's height, and the line at 0; of
                       // latitudes in a polar grid lines a radian of longitude and of latitude; of other graticules 0
    vec4 anchor;       // the graticule's: its column and row; 1 / reach
    vec4 shape;        // how many times as wide as in a window lines are; z, w: column and row of the eye less the anchor's
    vec4 bounds[16];   // of the areas of its polynomials (viewer/overlay/graticule.hpp): west, north, east, south
    vec4 borders[16];  // 1 where a side is a border of UTM zones
    vec4 local[16];    // centre; 1 / reach
    vec4 terms[400];   // 25 an area
}
overlays;
