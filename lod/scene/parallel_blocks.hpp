#pragma once

#include <optional>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "geo/result.hpp"

namespace relevo::lod {

/// Calls work(i) for i in [0, count) on all cores. All are called; of several failures the one with the
/// lowest index is returned, so that the message does not depend on the threads.
template <class Work>
Result<void> for_each_block(int count, const Work& work) {
    std::vector<std::optional<Error>> errors(static_cast<std::size_t>(count));
    tbb::parallel_for(tbb::blocked_range<int>(0, count, 1), [&](const tbb::blocked_range<int>& range) {
        for (int i = range.begin(); i < range.end(); ++i) {
            const Result<void> done = work(i);
            if (!done) errors[static_cast<std::size_t>(i)] = done.error();
        }
    });
    for (auto& error : errors) {
        if (error) return std::move(*error);
    }
    return {};
}

}  // namespace relevo::lod
