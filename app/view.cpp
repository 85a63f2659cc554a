#include "app/command.hpp"

namespace relevo::app {
void add_view(CLI::App&, Action&) {}
}  // namespace relevo::app
