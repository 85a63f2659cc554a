#include "ingest/import_plan.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include "ingest/refusal.hpp"
#include "ingest/source/suspicions.hpp"

namespace relevo::ingest {
namespace {

constexpr std::uint64_t kDiskOfMetrics = 1;  // bytes a post, rounded up (docs/performance.md)

}  // namespace

MemoryBudget memory_of(const Mosaic& mosaic, const ImportOptions& options) {
    return divide_memory(options.memory_bytes, mosaic.frame(), mosaic.memory_bytes(),
                         tbb::this_task_arena::max_concurrency());
}

ImportPlan plan_of(const Mosaic& mosaic, const ImportOptions& options) {
    ImportPlan plan;
    plan.frame = mosaic.frame();
    plan.posts = static_cast<std::uint64_t>(plan.frame.columns) * static_cast<std::uint64_t>(plan.frame.rows);
    const auto side = static_cast<std::uint64_t>(plan.frame.padded_side());
    plan.padded_posts = side * side;
    const std::uint64_t height_bytes = mosaic.fits_int16() ? 2 : 4;
    plan.bytes_estimate = plan.posts * (height_bytes + kDiskOfMetrics);
    plan.memory_bytes = memory_of(mosaic, options).least;
    plan.resampling = mosaic.resampling_method();
    plan.vertical = mosaic.vertical();
    plan.sources = mosaic.sources();
    plan.notes = mosaic.notes();
    if (plan.resampling == "none" && options.mosaic.resampling)
        plan.notes.emplace_back("its own posts are kept: --resampling has nothing to do");
    for (const auto& source : plan.sources) {
        if (!source.operation_note.empty()) plan.notes.push_back(source.operation_note);
    }
    const auto suspected = suspicions_about(options.mosaic.sources);
    plan.notes.insert(plan.notes.end(), suspected.begin(), suspected.end());
    return plan;
}

std::string inputs_named(const ImportPlan& plan) {
    return plan.sources.size() == 1 ? plan.sources[0].name
                                    : fmt::format("the {} sources", plan.sources.size());
}

Result<void> check_size(const ImportPlan& plan, const ImportOptions& options) {
    if (plan.padded_posts > std::min(options.max_posts, ImportOptions::kMostPosts))
        return refusal(
            inputs_named(plan),
            fmt::format("the grid of {} x {} posts is padded to {} posts; at most {} are allowed",
                        plan.frame.columns, plan.frame.rows, plan.padded_posts,
                        std::min(options.max_posts, ImportOptions::kMostPosts)),
            options.max_posts < ImportOptions::kMostPosts
                ? "Take a part with --crop, make it coarser with --resolution, or raise --max-posts"
                : "Take a part with --crop, or make it coarser with --resolution");
    if (plan.memory_bytes > options.memory_bytes)
        return Error{ErrorKind::usage,
                     fmt::format("an import of {} x {} posts needs at least {} MiB of memory: raise --memory",
                                 plan.frame.columns, plan.frame.rows, (plan.memory_bytes >> 20) + 1)};
    return {};
}

}  // namespace relevo::ingest
