#include "ingest/source/gdal_messages.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace relevo::ingest {

GdalMessages::GdalMessages() {
    CPLPushErrorHandlerEx(collect, this);
}

GdalMessages::~GdalMessages() {
    CPLPopErrorHandler();
}

void GdalMessages::collect(CPLErr severity, CPLErrorNum, const char* message) {
    if (severity < CE_Warning) return;
    auto& messages = static_cast<GdalMessages*>(CPLGetErrorHandlerUserData())->messages_;
    // A broken file can repeat one complaint for each of its blocks.
    constexpr std::size_t kMost = 5;
    if (messages.size() < kMost && std::find(messages.begin(), messages.end(), message) == messages.end())
        messages.emplace_back(message);
}

std::string GdalMessages::text() const {
    return fmt::format("{}", fmt::join(messages_, "; "));
}

}  // namespace relevo::ingest
