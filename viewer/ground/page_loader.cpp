#include "viewer/ground/page_loader.hpp"

#include <algorithm>
#include <utility>

#include "lod/background_thread.hpp"

namespace relevo::viewer {

PageLoader::PageLoader(std::function<Result<PageTexels>(const Page&)> load, int threads)
    : load_(std::move(load)) {
    for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

PageLoader::~PageLoader() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    may_work_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

bool PageLoader::is_known(const Page& page) const {
    return std::find(begun_.begin(), begun_.end(), page) != begun_.end() ||
           std::any_of(ready_.begin(), ready_.end(),
                       [&](const Loaded& loaded) { return loaded.page == page; });
}

void PageLoader::request(std::vector<Page> pages) {
    {
        const std::lock_guard lock(mutex_);
        waiting_.clear();
        std::copy_if(pages.begin(), pages.end(), std::back_inserter(waiting_),
                     [&](const Page& page) { return !is_known(page); });
    }
    may_work_.notify_all();
}

bool PageLoader::is_waiting(const Page& page) {
    const std::lock_guard lock(mutex_);
    return std::find(waiting_.begin(), waiting_.end(), page) != waiting_.end();
}

std::optional<PageLoader::Loaded> PageLoader::take() {
    std::optional<Loaded> taken;
    {
        const std::lock_guard lock(mutex_);
        if (ready_.empty()) return std::nullopt;
        taken.emplace(std::move(ready_.front()));
        ready_.pop_front();
    }
    may_work_.notify_one();
    return taken;
}

std::optional<PageLoader::Loaded> PageLoader::wait() {
    {
        std::unique_lock lock(mutex_);
        something_ready_.wait(lock, [&] { return !ready_.empty() || (waiting_.empty() && begun_.empty()); });
    }
    return take();
}

void PageLoader::work() {
    lod::stand_back();
    std::unique_lock lock(mutex_);
    while (true) {
        // A page that is begun will be ready: it counts.
        may_work_.wait(lock, [&] {
            return stopping_ || (!waiting_.empty() && ready_.size() + begun_.size() < kMostReady);
        });
        if (stopping_) return;
        const Page page = waiting_.front();
        waiting_.pop_front();
        begun_.push_back(page);
        lock.unlock();
        Result<PageTexels> texels = load_(page);
        lock.lock();
        begun_.erase(std::find(begun_.begin(), begun_.end(), page));
        ready_.push_back({page, std::move(texels)});
        something_ready_.notify_one();
    }
}

}  // namespace relevo::viewer
