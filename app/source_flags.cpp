#include "app/source_flags.hpp"

namespace relevo::app {

void SourceFlags::add_to(CLI::App& command) {
    command.add_option("--band", band, "The band with the heights, counted from 1")->type_name("N");
    command.add_option("--variable", variable, "The variable with the heights (NetCDF, HDF)")
        ->type_name("NAME");
    command
        .add_option("--raw", raw,
                    "The file has no header: columns x rows, type (int16, float32, ...), byte order")
        ->type_name("WxH,TYPE,le|be")
        ->check([](const std::string& text) {
            const auto layout = ingest::raw_layout(text);
            return layout ? std::string{} : layout.error().message;
        });
    command.add_option("--encoding", encoding, "How heights are packed into colours")
        ->check(CLI::IsMember({"terrain-rgb", "terrarium"}));
    command.add_flag("--allow-remote", allow_remote, "Inputs may lie in a network");
    command.add_option("--allow-path", allow_paths, "A folder that VRTs may read besides their own")
        ->type_name("DIR")
        ->allow_extra_args(false);
}

void SourceFlags::apply(ingest::SourceRequest& request) const {
    request.band = band;
    request.variable = variable;
    if (!raw.empty()) request.raw = *ingest::raw_layout(raw);
    request.encoding = ingest::height_encoding_from(encoding);
    request.trust.allow_remote = allow_remote;
    request.trust.allow_paths.assign(allow_paths.begin(), allow_paths.end());
}

}  // namespace relevo::app
