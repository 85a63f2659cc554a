#include "ingest/source/source_pool.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "ingest/refusal.hpp"
#include "lod/scene/parallel_blocks.hpp"

namespace relevo::ingest {
namespace {

/// CRSs that mean the same become one object, whatever their files call them.
class DistinctCrs {
  public:
    Result<std::shared_ptr<const Crs>> find(const std::string& wkt) {
        const auto known = by_definition_.find(wkt);
        if (known != by_definition_.end()) return known->second;
        auto crs = Crs::parse(wkt);
        if (!crs) return crs.error();
        for (const auto& other : distinct_)
            if (proj_is_equivalent_to_with_ctx(crs->context().get(), crs->horizontal(), other->horizontal(),
                                               PJ_COMP_EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS) != 0)
                return by_definition_[wkt] = other;
        distinct_.push_back(std::make_shared<const Crs>(std::move(*crs)));
        return by_definition_[wkt] = distinct_.back();
    }

  private:
    std::map<std::string, std::shared_ptr<const Crs>> by_definition_;
    std::vector<std::shared_ptr<const Crs>> distinct_;
};

SourceFacts facts_of(const Source& source) {
    SourceFacts facts;
    facts.name = source.name();
    facts.file = source.file();
    facts.all_files = source.all_files();
    facts.columns = source.columns();
    facts.rows = source.rows();
    facts.posts = source.posts();
    facts.crs_name = source.crs().name();
    facts.crs_wkt = source.crs().wkt();
    facts.step_unit = source.crs().unit();
    facts.heights = source.heights();
    facts.whole_metres = source.whole_metres();
    facts.value_type = source.value_type();
    facts.notes = source.notes();
    return facts;
}

}  // namespace

Result<SourcePool> SourcePool::open(std::vector<SourceRequest> requests) {
    SourcePool pool;
    pool.requests_ = std::move(requests);
    pool.facts_.resize(pool.requests_.size());
    pool.slots_ = std::make_unique<Slots>(pool.requests_.size());
    auto opened = lod::for_each_block(pool.count(), [&](int i) -> Result<void> {
        const auto index = static_cast<std::size_t>(i);
        auto source = Source::open(pool.requests_[index]);
        if (!source) return source.error();
        pool.facts_[index] = facts_of(*source);
        // The first ones stay open: with few sources none is opened twice.
        if (i < kMostOpen) {
            pool.slots_->all[index].source = std::move(*source);
            const std::scoped_lock lock{pool.slots_->choosing};
            pool.slots_->open.push_back(i);
        }
        return {};
    });
    if (!opened) return opened.error();
    DistinctCrs distinct;
    for (SourceFacts& facts : pool.facts_) {
        auto crs = distinct.find(facts.crs_wkt);
        if (!crs) return crs.error();
        facts.crs = std::move(*crs);
    }
    return pool;
}

/// Closes the source that was used longest ago among those that nobody reads. \pre `choosing` is locked
void SourcePool::make_room() const {
    Slots& slots = *slots_;
    std::sort(slots.open.begin(), slots.open.end(), [&](int a, int b) {
        return slots.all[static_cast<std::size_t>(a)].last_use <
               slots.all[static_cast<std::size_t>(b)].last_use;
    });
    for (auto at = slots.open.begin(); at != slots.open.end(); ++at) {
        Slot& oldest = slots.all[static_cast<std::size_t>(*at)];
        const std::unique_lock unused{oldest.reading, std::try_to_lock};
        if (!unused) continue;
        oldest.source.reset();
        slots.open.erase(at);
        return;
    }
}

/// \pre the source's `reading` is locked
Result<void> SourcePool::make_open(int source) const {
    Slot& slot = slots_->all[static_cast<std::size_t>(source)];
    {
        const std::scoped_lock lock{slots_->choosing};
        slot.last_use = ++slots_->uses;
        if (slot.source) return {};
        if (slots_->open.size() >= kMostOpen) make_room();
        slots_->open.push_back(source);
    }
    auto opened = Source::open(requests_[static_cast<std::size_t>(source)]);
    if (opened && opened->columns() == facts(source).columns && opened->rows() == facts(source).rows) {
        slot.source = std::move(*opened);
        return {};
    }
    const std::scoped_lock lock{slots_->choosing};
    std::erase(slots_->open, source);
    if (!opened) return opened.error();
    return refusal(facts(source).name, "it changed while it was read", "Import it again");
}

Result<lod::Raster<double>> SourcePool::read(int source, Window window) const {
    Slot& slot = slots_->all[static_cast<std::size_t>(source)];
    const std::scoped_lock one_at_a_time{slot.reading};
    if (auto open = make_open(source); !open) return open.error();
    return slot.source->read(window);
}

}  // namespace relevo::ingest
