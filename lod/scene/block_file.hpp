#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geo/result.hpp"

namespace relevo::lod {

/// Where the samples of a block lie on the earth: the centre of the first one and the steps, in degrees
/// (EPSG:4326) or metres (EPSG:5041 and EPSG:5042, UPS).
struct GeoReference {
    int epsg = 4326;
    double west = 0;
    double north = 0;
    double step_x = 0;
    double step_y = 0;
};

/// The size of a block file's image. Its samples lie band by band, each row by row.
struct BlockShape {
    int columns = 0;
    int rows = 0;
    int bands = 1;

    std::size_t samples() const {
        return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) *
               static_cast<std::size_t>(bands);
    }
};

/// How hard compressing without loss tries. Heights take 1 to 2 % more with little effort.
enum class Effort { usual, little };

/// The bytes of a GeoTIFF that holds the samples: one strip a band, compressed, pixel-is-point. The same
/// samples give the same bytes. T is std::int16_t (nodata -32768), std::uint8_t or std::uint16_t (none) or
/// float (NaN). \param max_error  0: without loss; else LERC may change samples by at most this
template <class T>
Result<std::vector<std::byte>> encode_block(std::span<const T> samples, BlockShape shape,
                                            const std::optional<GeoReference>& where, double max_error = 0,
                                            Effort effort = Effort::usual);

/// The samples in the bytes of a block file, which must have exactly that shape and type.
/// \param name   for the message; fails with ErrorKind::damaged
/// \param bands  those to read, from 1, in the order in which they are wanted; none: all
template <class T>
Result<std::vector<T>> decode_block(std::span<const std::byte> bytes, BlockShape shape,
                                    const std::string& name, std::span<const int> bands = {});

/// Size of the image in the bytes of a block file of floats.
Result<BlockShape> block_shape(std::span<const std::byte> bytes, const std::string& name);

}  // namespace relevo::lod
