#pragma once

#include <string>

#include "geo/result.hpp"
#include "ingest/import.hpp"
#include "ingest/memory_budget.hpp"
#include "ingest/mosaic/mosaic.hpp"

namespace relevo::ingest {

/// What an import of a mosaic would make.
ImportPlan plan_of(const Mosaic& mosaic, const ImportOptions& options);

/// How an import divides the memory that it may take.
MemoryBudget memory_of(const Mosaic& mosaic, const ImportOptions& options);

/// Is it within the limits that the options set?
Result<void> check_size(const ImportPlan& plan, const ImportOptions& options);

/// The one source by its name, several by their number: for messages.
std::string inputs_named(const ImportPlan& plan);

}  // namespace relevo::ingest
