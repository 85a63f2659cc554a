#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "app/stop_on_signal.hpp"
#include "lod/lstr/chunk_file.hpp"
#include "lod/lstr/chunk_making.hpp"
#include "lod/lstr/chunk_replace.hpp"

namespace relevo::app {

namespace {

struct ChunksOptions : Common {
    std::filesystem::path scene;
    std::string node;
    std::filesystem::path mesh;
    std::string margin = "screen";
    lod::RemovalTest filter = lod::RemovalTest::pairs;
};

/// LEVEL/COLUMN/ROW.
Result<lod::ChunkId> parse_node(const std::string& text) {
    lod::ChunkId id;
    int read = 0;
    if (std::sscanf(text.c_str(), "%d/%d/%d%n", &id.level, &id.column, &id.row, &read) != 3 ||
        static_cast<std::size_t>(read) != text.size())
        return Error{ErrorKind::usage, fmt::format("{}: a node is LEVEL/COLUMN/ROW, as 3/0/2", text)};
    return id;
}

struct Opened {
    lod::Scene scene;
    lod::Terrain terrain;
};

Result<Opened> open(const ChunksOptions& options) {
    auto scene = lod::Scene::open(options.scene);
    if (!scene) return scene.error();
    auto terrain = lod::Terrain::open(*scene, lod::ErrorMetric::bounded, {});
    if (!terrain) return terrain.error();
    return Opened{*std::move(scene), *std::move(terrain)};
}

/// \param margin  metres (2m), per cent of the range of the heights (0.1%), or what suits the screen
Result<lod::ChunkErrors> parse_margin(const std::string& margin, const Opened& opened) {
    if (margin == "screen") return lod::chunk_errors(opened.terrain);
    double number = 0;
    const char* end = margin.data() + margin.size();
    const auto [unit, status] = std::from_chars(margin.data(), end, number);
    const std::string_view rest(unit, static_cast<std::size_t>(end - unit));
    if (status != std::errc() || !std::isfinite(number) || number <= 0 || (rest != "m" && rest != "%")) {
        return Error{ErrorKind::usage,
                     fmt::format("--margin {}: it is in metres (2m), per cent of the range of the heights "
                                 "(0.1%), or `screen`",
                                 margin)};
    }
    if (rest == "m") return lod::ChunkErrors{number};
    const double range_m = opened.scene.info().height_max_m - opened.scene.info().height_min_m;
    if (!(range_m > 0)) {
        return Error{ErrorKind::input,
                     fmt::format("--margin {}: all heights are the same; give it in metres", margin)};
    }
    return lod::ChunkErrors{0.01 * number * range_m};
}

Result<void> make(const ChunksOptions& options) {
    auto opened = open(options);
    if (!opened) return opened.error();
    const auto errors = parse_margin(options.margin, *opened);
    if (!errors) return errors.error();
    if (auto done = make_chunks(opened->scene, opened->terrain, {*errors, options.filter}, options); !done)
        return done;
    const auto file = lod::ChunkFile::open(opened->scene, opened->terrain);
    if (!file) return file.error();
    if (options.json) {
        std::cout << nlohmann::ordered_json{{"nodes", file->index().size()},
                                            {"bytes", file->bytes()},
                                            {"margin_m", file->errors().first_m}}
                         .dump(2)
                  << '\n';
    } else {
        fmt::print("{}: {} nodes, {} bytes, margin {:.3g} m\n", file->name(), file->index().size(),
                   file->bytes(), file->errors().first_m);
    }
    return {};
}

Result<void> extract(const ChunksOptions& options) {
    const auto id = parse_node(options.node);
    if (!id) return id.error();
    auto opened = open(options);
    if (!opened) return opened.error();
    const auto file = lod::ChunkFile::open(opened->scene, opened->terrain);
    if (!file) return file.error();
    if (!file->index().has(*id))
        return Error{ErrorKind::usage, fmt::format("{}: no such node", options.node)};
    const auto mesh = file->mesh(*id);
    if (!mesh) return mesh.error();
    lod::ChunkGeometry geometry{{}, (*mesh)->triangles};
    for (const lod::ChunkVertex& vertex : (*mesh)->vertices)
        geometry.vertices.push_back({vertex.at, vertex.H});
    std::ofstream out(options.mesh);
    out << lod::to_obj(geometry);
    if (!out.flush())
        return Error{ErrorKind::input, fmt::format("{}: cannot be written", options.mesh.string())};
    if (!options.quiet && !options.json)
        fmt::print("{}: {} triangles, at most {:.3g} m off\n", options.mesh.string(),
                   geometry.triangles.size(), (*mesh)->error_m);
    return {};
}

Result<void> replace(const ChunksOptions& options) {
    const auto id = parse_node(options.node);
    if (!id) return id.error();
    if (!std::filesystem::is_regular_file(options.mesh))
        return Error{ErrorKind::input, fmt::format("{}: no such file", options.mesh.string())};
    std::ifstream in(options.mesh);
    const std::string text(std::istreambuf_iterator<char>(in), {});
    if (!in) return Error{ErrorKind::input, fmt::format("{}: cannot be read", options.mesh.string())};
    const auto geometry = lod::from_obj(text, options.mesh.string());
    if (!geometry) return geometry.error();
    auto opened = open(options);
    if (!opened) return opened.error();
    const auto error_m = lod::replace_chunk(opened->scene, opened->terrain, *id, *geometry);
    if (!error_m) {
        return Error{error_m.error().kind, fmt::format("{}, for node {}: {}", options.mesh.string(),
                                                       options.node, error_m.error().message)};
    }
    if (options.json)
        std::cout << nlohmann::ordered_json{{"max_error_m", *error_m}}.dump(2) << '\n';
    else
        fmt::print("node {}: {} triangles, at most {:.3g} m off the ground\n", options.node,
                   geometry->triangles.size(), *error_m);
    return {};
}

}  // namespace

Result<void> make_chunks(const lod::Scene& scene, const lod::Terrain& terrain,
                         const lod::ChunkBuilding& building, const Common& common) {
    const StopOnSignal signals;
    const auto bar = progress_bar(common, "making the quadtree");
    return lod::make_chunk_file(scene, terrain, building, [&](double done) {
        bar(done);
        return !signals.stop_asked();
    });
}

Result<void> provide_chunks(const lod::Scene& scene, lod::Terrain& terrain, const Common& common) {
    const auto bar = progress_bar(common, "making the quadtree");
    return lod::provide_chunks(scene, terrain, [&](double done) {
        bar(done);
        return true;
    });
}

void add_chunks(CLI::App& program, Action& action) {
    auto options = std::make_shared<ChunksOptions>();
    CLI::App* command = program.add_subcommand("chunks", "The nodes that `--lod lstr` draws: chunks.bin");
    command->require_subcommand(1);
    const auto add = [&](const char* name, const char* what, bool names_node, auto act) {
        CLI::App* added = command->add_subcommand(name, what);
        added->add_option("SCENE", options->scene, "The scene's folder")->required();
        if (names_node) {
            added->add_option("NODE", options->node, "LEVEL/COLUMN/ROW, from 1/0/0 on")->required();
            added->add_option("MESH", options->mesh, "OBJ file: v COLUMN ROW H, f A B C")->required();
        }
        add_common(*added, *options);
        added->callback([options, &action, act] { action = [options, act] { return act(*options); }; });
        return added;
    };
    CLI::App* made = add("make", "Make the file, or go on with what was stopped", false, make);
    made->add_option(
            "--margin", options->margin,
            "How far level 1 may be off: metres (2m), per cent of the range of the heights (0.1%), or "
            "`screen`, 0.15 posts")
        ->capture_default_str();
    made->add_option("--filter", options->filter,
                     "Which posts go first: those near the means of `pairs` that "
                     "face each other, or near the `mean` of all eight around")
        ->transform(CLI::CheckedTransformer(std::map<std::string, lod::RemovalTest>{
            {"pairs", lod::RemovalTest::pairs}, {"mean", lod::RemovalTest::mean}}))
        ->default_str("pairs");
    made->footer("Example: relevo chunks make fuji.relevo --margin 2m");
    add("extract", "Write a node's mesh", true, extract)
        ->footer("Example: relevo chunks extract fuji.relevo 2/3/1 node.obj");
    add("replace", "Put another mesh in a node's place; its sides must stay the same", true, replace)
        ->footer("Example: relevo chunks replace fuji.relevo 2/3/1 node.obj");
}

}  // namespace relevo::app
