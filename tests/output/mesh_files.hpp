#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/lod/scratch_scene.hpp"

namespace relevo::test {

/// A mesh as a file has it: read by code of its own.
struct ReadMesh {
    std::vector<std::array<double, 3>> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::string about;  ///< comments, or asset.extras as JSON
};

template <class T>
T number_at(const std::string& bytes, std::size_t at) {
    T value{};
    EXPECT_LE(at + sizeof(T), bytes.size());
    if (at + sizeof(T) <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof(T));
    return value;
}

inline ReadMesh read_ply(const std::filesystem::path& file) {
    const std::string bytes = contents(file);
    ReadMesh mesh;
    const std::string end = "end_header\n";
    const std::size_t header = bytes.find(end);
    EXPECT_NE(header, std::string::npos);
    std::istringstream lines(bytes.substr(0, header));
    std::vector<std::string> rest;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("comment ")) {
            mesh.about += line.substr(8) + "\n";
        } else {
            rest.push_back(line);
        }
    }
    EXPECT_EQ(rest.size(), 8u);
    if (rest.size() != 8) return mesh;
    EXPECT_EQ(rest[0], "ply");
    EXPECT_EQ(rest[1], "format binary_little_endian 1.0");
    EXPECT_EQ(rest[3], "property double x");
    EXPECT_EQ(rest[5], "property double z");
    EXPECT_EQ(rest[7], "property list uchar uint vertex_indices");
    mesh.vertices.resize(std::stoul(rest[2].substr(std::string("element vertex ").size())));
    mesh.triangles.resize(std::stoul(rest[6].substr(std::string("element face ").size())));
    std::size_t at = header + end.size();
    for (auto& vertex : mesh.vertices)
        for (double& coordinate : vertex) {
            coordinate = number_at<double>(bytes, at);
            at += 8;
        }
    for (auto& triangle : mesh.triangles) {
        EXPECT_EQ(number_at<std::uint8_t>(bytes, at++), 3);
        for (std::uint32_t& i : triangle) {
            i = number_at<std::uint32_t>(bytes, at);
            at += 4;
        }
    }
    EXPECT_EQ(at, bytes.size());
    return mesh;
}

/// Positions with the origin added, as the file's extras say.
inline ReadMesh read_glb(const std::filesystem::path& file) {
    const std::string bytes = contents(file);
    ReadMesh mesh;
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(number_at<std::uint32_t>(bytes, 4), 2u);
    EXPECT_EQ(number_at<std::uint32_t>(bytes, 8), bytes.size());
    const std::size_t json_bytes = number_at<std::uint32_t>(bytes, 12);
    EXPECT_EQ(json_bytes % 4, 0u);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    const auto json = nlohmann::json::parse(bytes.substr(20, json_bytes), nullptr, false);
    EXPECT_TRUE(json.is_object());
    if (!json.is_object()) return mesh;
    const std::size_t data = 20 + json_bytes + 8;
    EXPECT_EQ(number_at<std::uint32_t>(bytes, data - 8), bytes.size() - data);
    EXPECT_EQ(bytes.substr(data - 4, 4), std::string("BIN\0", 4));
    EXPECT_EQ(json["buffers"][0]["byteLength"], bytes.size() - data);
    EXPECT_EQ(json["asset"]["version"], "2.0");
    EXPECT_EQ(json["scenes"][0]["nodes"][0], 0);
    const auto& primitive = json["meshes"][json["nodes"][0]["mesh"].get<std::size_t>()]["primitives"][0];
    const auto& extras = json["asset"]["extras"];
    mesh.about = extras.dump();

    const auto& positions = json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
    EXPECT_EQ(positions["componentType"], 5126);
    EXPECT_EQ(positions["type"], "VEC3");
    const auto& view = json["bufferViews"][positions["bufferView"].get<std::size_t>()];
    std::size_t at = data + view["byteOffset"].get<std::size_t>();
    std::array<float, 3> least{1e30F, 1e30F, 1e30F};
    std::array<float, 3> most{-1e30F, -1e30F, -1e30F};
    mesh.vertices.resize(positions["count"].get<std::size_t>());
    EXPECT_EQ(view["byteLength"], 12 * mesh.vertices.size());
    for (auto& vertex : mesh.vertices) {
        for (std::size_t i = 0; i < 3; ++i) {
            const float coordinate = number_at<float>(bytes, at);
            least[i] = std::min(least[i], coordinate);
            most[i] = std::max(most[i], coordinate);
            vertex[i] = static_cast<double>(coordinate) + extras["positions_relative_to"][i].get<double>();
            at += 4;
        }
    }
    EXPECT_EQ((positions["min"].get<std::array<float, 3>>()), least);
    EXPECT_EQ((positions["max"].get<std::array<float, 3>>()), most);

    const auto& corners = json["accessors"][primitive["indices"].get<std::size_t>()];
    EXPECT_EQ(corners["componentType"], 5125);
    EXPECT_EQ(corners["type"], "SCALAR");
    at =
        data + json["bufferViews"][corners["bufferView"].get<std::size_t>()]["byteOffset"].get<std::size_t>();
    mesh.triangles.resize(corners["count"].get<std::size_t>() / 3);
    for (auto& triangle : mesh.triangles)
        for (std::uint32_t& i : triangle) {
            i = number_at<std::uint32_t>(bytes, at);
            at += 4;
        }
    EXPECT_EQ(at, bytes.size());
    return mesh;
}

inline ReadMesh read_obj(const std::filesystem::path& file) {
    std::istringstream lines(contents(file));
    ReadMesh mesh;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line.substr(std::min<std::size_t>(2, line.size())));
        if (line.starts_with("# ")) {
            mesh.about += line.substr(2) + "\n";
        } else if (line.starts_with("v ")) {
            auto& p = mesh.vertices.emplace_back();
            words >> p[0] >> p[1] >> p[2];
            EXPECT_FALSE(words.fail()) << line;
        } else if (line.starts_with("f ")) {
            auto& t = mesh.triangles.emplace_back();
            words >> t[0] >> t[1] >> t[2];
            EXPECT_FALSE(words.fail()) << line;
            for (std::uint32_t& i : t) --i;
        } else {
            ADD_FAILURE() << line;
        }
    }
    return mesh;
}

}  // namespace relevo::test
