#include "viewer/frame_budget.hpp"

#include <algorithm>
#include <cmath>

namespace relevo::viewer {

namespace {

/// Triangles go like tau^-kPower: 1.1 to 1.7 on real terrain between 0.25 and 16 pixels.
constexpr double kPower = 1.5;
/// Part of the way to the tau asked for that a frame goes. With kPower too small by a half it is still one
/// way, without coming back.
constexpr double kShare = 0.4;
/// No frame's tau differs from the last by more: what is drawn changes smoothly.
constexpr double kCoarserStep = 0.22;  // ln: 25 %
constexpr double kFinerStep = 0.10;    // 11 %
/// Loads within this of what is aimed at are right as they are.
constexpr double kDeadBand = 0.05;
/// Frames that are forgotten by 1/e.
constexpr double kMemory = 30;
/// The times of frames tell their fixed part only where triangles differ by more than this part of them.
constexpr double kTellingSpread = 0.1;
/// The least part of a frame's time that is taken to follow its triangles.
constexpr double kLeastPart = 0.15;
/// A frame that differs by more than this part from what was expected is one that nothing was learnt about.
constexpr double kSurprise = 0.25;

}  // namespace

FrameBudget::FrameBudget(const BudgetLimits& limits, double tau_px)
    : limits_(limits), finest_px_(tau_px), finest_(std::log(tau_px)), log_tau_(finest_) {}

double FrameBudget::tau_px() const {
    return log_tau_ <= finest_ ? finest_px_ : std::exp(log_tau_);
}

void FrameBudget::set_finest(double tau_px) {
    finest_px_ = tau_px;
    finest_ = std::log(tau_px);
    log_tau_ = std::clamp(log_tau_, finest_, std::max(finest_, std::log(kCoarsestPx)));
}

bool FrameBudget::holds(double frame_ms, std::uint64_t triangles) const {
    return !(limits_.frame_ms && frame_ms > *limits_.frame_ms) &&
           !(limits_.triangles && triangles > *limits_.triangles);
}

void FrameBudget::learn(double frame_ms, double triangles) {
    // Where triangles cost something else than they did, what was learnt leads astray; a single slow frame
    // does not say so.
    const double expected = mean_ms_ + ms_per_triangle() * (triangles - mean_triangles_);
    surprises_ = learnt_ > 0 && std::abs(frame_ms - expected) > kSurprise * expected ? surprises_ + 1 : 0;
    if (surprises_ >= 3) learnt_ = surprises_ = 0;
    if (learnt_ == 0) mean_ms_ = mean_triangles_ = variance_ = covariance_ = 0;

    ++learnt_;
    const double weight = 1 / std::min(static_cast<double>(learnt_), kMemory);
    const double ms = frame_ms - mean_ms_;
    const double count = triangles - mean_triangles_;
    mean_ms_ += weight * ms;
    mean_triangles_ += weight * count;
    variance_ += weight * ((1 - weight) * count * count - variance_);
    covariance_ += weight * ((1 - weight) * count * ms - covariance_);
}

/// c of ms = a + c triangles, pulled towards a = 0 where the frames were all alike.
double FrameBudget::ms_per_triangle() const {
    if (mean_triangles_ <= 0) return 0;
    const double proportional = mean_ms_ / mean_triangles_;
    if (covariance_ <= 0) return proportional;
    const double pull = std::pow(kTellingSpread * mean_triangles_, 2);
    return std::min((covariance_ + pull * proportional) / (variance_ + pull), proportional);
}

/// The step in ln tau that the limits ask for: the larger where both do.
double FrameBudget::wanted_step() const {
    const double part =
        mean_ms_ > 0 ? std::max(ms_per_triangle() * mean_triangles_ / mean_ms_, kLeastPart) : 1.0;

    const auto step_of = [&](std::array<Frame, kRemembered> frames, double elasticity) {
        // As if all had been drawn with the tau of now.
        const auto seen = static_cast<std::size_t>(std::min<std::uint64_t>(frames_, kRemembered));
        std::array<double, kRemembered> loads{};
        for (std::size_t i = 0; i < seen; ++i)
            loads[i] = frames[i].log_load - elasticity * (log_tau_ - frames[i].log_tau);
        std::sort(loads.begin(), loads.begin() + static_cast<std::ptrdiff_t>(seen));
        const double load = loads[(seen - 1) / 2];
        return std::abs(load) < kDeadBand ? 0 : load / elasticity;
    };
    double step = -kFinerStep / kShare;
    if (limits_.frame_ms) step = std::max(step, step_of(time_, kPower * part));
    if (limits_.triangles) {
        // Counts have no noise: the last one is enough.
        const auto last = count_[(frames_ - 1) % kRemembered];
        const double load = last.log_load;
        step = std::max(step, load > -kDeadBand && load < kDeadBand ? 0 : load / kPower);
    }
    return step;
}

void FrameBudget::add(double frame_ms, std::uint64_t triangles) {
    const auto count = static_cast<double>(std::max<std::uint64_t>(triangles, 1));
    const std::size_t slot = frames_ % kRemembered;
    ++frames_;
    learn(frame_ms, count);
    const auto load = [](double cost, double limit) {
        return std::log(std::max(cost, 1e-6) / (kAim * std::max(limit, 1e-6)));
    };
    if (limits_.frame_ms) time_[slot] = {log_tau_, load(frame_ms, *limits_.frame_ms)};
    if (limits_.triangles) count_[slot] = {log_tau_, load(count, static_cast<double>(*limits_.triangles))};
    if (!limits_.any()) return;

    const double step = std::clamp(kShare * wanted_step(), -kFinerStep, kCoarserStep);
    const double before = log_tau_;
    log_tau_ = std::clamp(log_tau_ + step, finest_, std::max(finest_, std::log(kCoarsestPx)));
    small_steps_ = std::abs(log_tau_ - before) < 0.01 ? small_steps_ + 1 : 0;
}

}  // namespace relevo::viewer
