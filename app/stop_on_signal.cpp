#include "app/stop_on_signal.hpp"

namespace relevo::app {
namespace {

volatile sig_atomic_t asked = 0;

}  // namespace

StopOnSignal::StopOnSignal() {
    struct sigaction action {};
    action.sa_handler = [](int) { asked = 1; };
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, &old_interrupt_);
    sigaction(SIGTERM, &action, &old_terminate_);
}

StopOnSignal::~StopOnSignal() {
    sigaction(SIGINT, &old_interrupt_, nullptr);
    sigaction(SIGTERM, &old_terminate_, nullptr);
}

bool StopOnSignal::stop_asked() const {
    return asked != 0;
}

}  // namespace relevo::app
