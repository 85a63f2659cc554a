#include <clocale>
#include <csignal>
#include <exception>

#include <fmt/format.h>
#include <gdal.h>
#include <proj.h>

#include "app/command.hpp"

namespace {

int exit_status(relevo::ErrorKind kind) {
    switch (kind) {
        case relevo::ErrorKind::usage:
            return 2;
        case relevo::ErrorKind::input:
            return 3;
        case relevo::ErrorKind::damaged:
            return 4;
        case relevo::ErrorKind::internal:
            break;
    }
    return 1;
}

std::string version() {
    return fmt::format("relevo {} (GDAL {}, PROJ {})", RELEVO_VERSION, GDALVersionInfo("RELEASE_NAME"),
                       proj_info().version);
}

int run(int argc, char** argv) {
    using namespace relevo;
    CLI::App program{"Import elevation models, fly over them, measure in them.", "relevo"};
    program.set_version_flag("--version", version());
    program.require_subcommand(1);

    app::Action action;
    app::add_ingest(program, action);
    app::add_info(program, action);
#ifdef RELEVO_VIEWER
    app::add_view(program, action);
    app::add_render(program, action);
    app::add_bench(program, action);
#endif
    app::add_measure(program, action);
    app::add_check(program, action);
    app::add_chunks(program, action);
    app::add_export(program, action);

    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return program.exit(error) == 0 ? 0 : exit_status(ErrorKind::usage);
    }
    if (const auto done = action(); !done) {
        fmt::print(stderr, "relevo: {}\n", done.error().message);
        return exit_status(done.error().kind);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    std::setlocale(LC_ALL, "C");    // numbers are written and read the same way everywhere
    std::signal(SIGXFSZ, SIG_IGN);  // a file over the user's limit is an error of that write, with a message
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "relevo: internal error: {}\n", error.what());
        return 1;
    }
}
