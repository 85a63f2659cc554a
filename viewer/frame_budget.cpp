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
/// Where frames have a time, the first are coarse: what they cost here nobody knows yet.
constexpr double kBeginningPx = 8;
/// Loads within this of what is aimed at are right as they are.
constexpr double kDeadBand = 0.05;
/// Frames that are forgotten by 1/e: what they cost, and how they scatter.
constexpr double kMemory = 30;
constexpr double kScatterMemory = 60;
/// Standard deviations that are kept to the limit. Of a normal distribution one frame in 400 would be beyond;
/// frames' times have longer tails.
constexpr double kDeviations = 2.8;
/// One very slow frame says little about the others.
constexpr double kMostScatter = 0.5;
constexpr double kLeastAim = 0.5;
/// The most of the memory for the terrain that is aimed at.
constexpr double kMemoryAim = 0.95;
/// The times of frames tell their fixed part only where triangles differ by more than this part of them.
constexpr double kTellingSpread = 0.1;
/// The least part of a frame's time that is taken to follow its triangles.
constexpr double kLeastPart = 0.15;
/// A frame that differs by more than this part from what was expected is one that nothing was learnt about.
constexpr double kSurprise = 0.25;

}  // namespace

FrameBudget::FrameBudget(const BudgetLimits& limits, double tau_px)
    : limits_(limits),
      finest_px_(tau_px),
      finest_(std::log(tau_px)),
      log_tau_(limits.frame_ms ? std::max(finest_, std::log(kBeginningPx)) : finest_) {}

double FrameBudget::tau_px() const {
    return log_tau_ <= finest_ ? finest_px_ : std::exp(log_tau_);
}

void FrameBudget::set_finest(double tau_px) {
    finest_px_ = tau_px;
    finest_ = std::log(tau_px);
    log_tau_ = std::clamp(log_tau_, finest_, std::max(finest_, std::log(kCoarsestPx)));
}

bool FrameBudget::holds(const FrameCost& cost) const {
    return !(limits_.frame_ms && cost.ms > *limits_.frame_ms) &&
           !(limits_.triangles && cost.triangles > *limits_.triangles);
}

void FrameBudget::learn(double frame_ms, double triangles) {
    const double off = learnt_ > 0 ? frame_ms / expected_ms(triangles) - 1 : 0;
    const double off2 = std::pow(std::clamp(off, -kMostScatter, kMostScatter), 2);
    if (std::abs(off) > kSurprise) {
        ++surprises_;
        surprise2_ += off2;
    } else {
        if (learnt_ >= kRemembered)
            scatter2_ +=
                (off2 + surprise2_ - scatter2_) / std::min(static_cast<double>(frames_), kScatterMemory);
        surprises_ = 0;
        surprise2_ = 0;
    }
    // Where triangles cost something else than they did, what was learnt leads astray; a single slow frame
    // does not say so, but that frames scatter.
    if (surprises_ >= 3) learnt_ = surprises_ = 0;
    if (learnt_ == 0) mean_ms_ = mean_triangles_ = variance_ = covariance_ = surprise2_ = 0;

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

double FrameBudget::expected_ms(double triangles) const {
    return mean_ms_ + ms_per_triangle() * (triangles - mean_triangles_);
}

/// The part of the time that is aimed at.
double FrameBudget::aim() const {
    return std::clamp(1 / (1 + kDeviations * std::sqrt(scatter2_)), kLeastAim, kAim);
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
    const auto step_of_exact = [](double load) { return std::abs(load) < kDeadBand ? 0 : load / kPower; };
    if (limits_.triangles) step = std::max(step, step_of_exact(count_load_));
    return std::max(step, step_of_exact(memory_load_));
}

void FrameBudget::step(double by) {
    log_tau_ = std::clamp(log_tau_ + by, finest_, std::max(finest_, std::log(kCoarsestPx)));
}

bool FrameBudget::coarsen(std::uint64_t triangles) {
    if (!limits_.frame_ms || learnt_ < kRemembered) return false;
    const auto count = static_cast<double>(triangles);
    const double load = expected_ms(count) / *limits_.frame_ms;
    if (load <= 1) return false;
    const double part = std::max(ms_per_triangle() * count / expected_ms(count), kLeastPart);
    const double before = log_tau_;
    step(std::log(load / aim()) / (kPower * part));
    return log_tau_ > before;
}

void FrameBudget::add(const FrameCost& cost) {
    const auto count = static_cast<double>(std::max<std::uint64_t>(cost.triangles, 1));
    const std::size_t slot = frames_ % kRemembered;
    ++frames_;
    learn(cost.ms, count);
    const auto load = [](double of, double limit) {
        return std::log(std::max(of, 1e-6) / std::max(limit, 1e-6));
    };
    if (limits_.frame_ms) time_[slot] = {log_tau_, load(cost.ms, aim() * *limits_.frame_ms)};
    if (limits_.triangles) count_load_ = load(count, kAim * static_cast<double>(*limits_.triangles));
    memory_load_ = load(cost.memory, kMemoryAim);

    const double before = log_tau_;
    step(std::clamp(kShare * wanted_step(), -kFinerStep, kCoarserStep));
    small_steps_ = std::abs(log_tau_ - before) < 0.01 ? small_steps_ + 1 : 0;
}

}  // namespace relevo::viewer
