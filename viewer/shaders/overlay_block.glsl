// What overlays are drawn with (viewer/overlay_block.hpp).
layout(std140, binding = 5) uniform Overlays {
    vec4 drawn[8];   // from the lowest: its opacity; of contours lines a unit of a texel's height, and the line at 0; of
                     // latitudes in a polar grid lines a radian of longitude and of latitude; of other graticules 0
    vec4 anchor;     // the graticule's: its column and row; 1 / reach
    vec4 terms[25];  // of its polynomials (viewer/graticule.hpp)
}
overlays;
