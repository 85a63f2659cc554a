#pragma once

#include <signal.h>

namespace relevo::app {

/// While it lives, Ctrl-C and SIGTERM do not end the program but ask it to stop: long work looks now and
/// then, ends at its next step, and takes away what it has written so far. One at a time.
class StopOnSignal {
  public:
    StopOnSignal();
    ~StopOnSignal();
    StopOnSignal(const StopOnSignal&) = delete;
    StopOnSignal& operator=(const StopOnSignal&) = delete;

    bool stop_asked() const;

  private:
    struct sigaction old_interrupt_ {};
    struct sigaction old_terminate_ {};
};

}  // namespace relevo::app
