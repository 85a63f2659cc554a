#pragma once

#include <string>
#include <vector>

#include <cpl_error.h>

namespace relevo::ingest {

/// Collects what GDAL says on this thread while it lives, in place of letting it print to stderr.
class GdalMessages {
  public:
    GdalMessages();
    ~GdalMessages();
    GdalMessages(const GdalMessages&) = delete;
    GdalMessages& operator=(const GdalMessages&) = delete;

    /// Everything said so far, warnings and errors in their order, for an error's message; empty where
    /// nothing was.
    std::string text() const;
    bool empty() const { return messages_.empty(); }

  private:
    static void CPL_STDCALL collect(CPLErr severity, CPLErrorNum, const char* message);

    std::vector<std::string> messages_;
};

}  // namespace relevo::ingest
