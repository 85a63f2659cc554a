#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "geo/result.hpp"
#include "viewer/ground/page_texels.hpp"

namespace relevo::viewer {

/// Loads pages in threads of its own, the most urgent first. What it holds is bounded: each thread one page
/// that it works on, and a few that nobody has taken yet. Its functions are for one thread.
class PageLoader {
  public:
    /// \param load  called from several threads at a time
    PageLoader(std::function<Result<PageTexels>(const Page&)> load, int threads);
    ~PageLoader();
    PageLoader(const PageLoader&) = delete;
    PageLoader& operator=(const PageLoader&) = delete;

    /// What shall be loaded, the most urgent first, instead of all that was asked for and is not begun.
    void request(std::vector<Page> pages);

    /// Is the page asked for and not begun?
    bool is_waiting(const Page& page);

    struct Loaded {
        Page page;
        Result<PageTexels> texels;
    };
    /// A page that is ready, in the order in which they became so; none if there is none now.
    std::optional<Loaded> take();
    /// Waits for one; none if nothing was asked for that has not been taken.
    std::optional<Loaded> wait();

  private:
    static constexpr std::size_t kMostReady = 16;

    void work();
    bool is_known(const Page& page) const;  // begun, or ready

    std::function<Result<PageTexels>(const Page&)> load_;
    std::mutex mutex_;
    std::condition_variable may_work_;
    std::condition_variable something_ready_;
    std::deque<Page> waiting_;
    std::vector<Page> begun_;
    std::deque<Loaded> ready_;
    bool stopping_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace relevo::viewer
