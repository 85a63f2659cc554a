#pragma once

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "geo/result.hpp"
#include "ingest/progress.hpp"

namespace relevo::ingest {

/// Calls work(i) for i in [0, count) on all cores, begun in their order: neighbouring blocks want the same
/// data at about the same time. Reading, computing and writing of different blocks overlap. Stops at the
/// first failure, or where the stage says so; of several failures the one with the lowest index is returned.
template <class Work>
Result<void> blocks_in_order(int count, const Stage& stage, const Work& work) {
    std::atomic<int> next = 0;
    std::atomic<bool> stop = false;
    std::mutex mutex;
    int done = 0;
    bool interrupt = false;
    std::optional<Error> error;
    int failed = count;
    const auto run = [&](int) {
        for (int i = 0; !stop && (i = next++) < count;) {
            Result<void> result = work(i);
            const std::lock_guard lock(mutex);
            if (!result) {
                stop = true;
                if (i < failed) {
                    failed = i;
                    error = std::move(result.error());
                }
            } else if (!stage(++done / static_cast<double>(count))) {
                stop = interrupt = true;
            }
        }
    };
    tbb::parallel_for(0, std::min(tbb::this_task_arena::max_concurrency(), std::max(count, 1)), run);
    if (error) return std::move(*error);
    if (interrupt) return interrupted();
    return {};
}

}  // namespace relevo::ingest
