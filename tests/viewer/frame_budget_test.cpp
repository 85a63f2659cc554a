#include "viewer/frame_budget.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace relevo::viewer {
namespace {

/// Frames whose cost is known: triangles = count / tau^power, ms = fixed + ms_per_triangle triangles, times
/// 1 + noise.
struct Machine {
    double fixed_ms = 20;
    double variable_ms = 40;  // for 1e5 triangles
    double power = 1.5;
    double noise = 0;
    std::mt19937_64 random{7};

    double count = 1e5;  // at tau 1

    double triangles(double tau) const { return count * std::pow(tau, -power); }
    double mean_ms(double tau) const { return fixed_ms + variable_ms * triangles(tau) / 1e5; }
    double ms(double tau) {
        // The mean of four uniform numbers is near enough to normal; its spread is `noise`.
        double sum = 0;
        for (int i = 0; i < 4; ++i) sum += static_cast<double>(random() >> 11) / 9007199254740992.0 - 0.5;
        return mean_ms(tau) * (1 + noise * sum * std::sqrt(3.0));
    }
    /// The tau at which a frame takes so long.
    double tau_for(double budget) const { return std::pow(variable_ms / (budget - fixed_ms), 1 / power); }
};

std::vector<double> run(FrameBudget& budget, Machine& machine, int frames) {
    std::vector<double> taus;
    for (int i = 0; i < frames; ++i) {
        const double tau = budget.tau_px();
        taus.push_back(tau);
        budget.add({machine.ms(tau), static_cast<std::uint64_t>(machine.triangles(tau))});
    }
    return taus;
}

struct Case {
    double fixed_ms, variable_ms, power, budget_ms;

    friend std::ostream& operator<<(std::ostream& stream, const Case& c) {
        return stream << fmt::format("{} ms + {} ms / tau^{} in {} ms", c.fixed_ms, c.variable_ms, c.power,
                                     c.budget_ms);
    }
};

class Budgets : public testing::TestWithParam<Case> {
  protected:
    Machine machine() const {
        return {.fixed_ms = GetParam().fixed_ms,
                .variable_ms = GetParam().variable_ms,
                .power = GetParam().power};
    }
};

TEST_P(Budgets, BeginsCoarseAndComesToItsTimeOneWay) {
    Machine m = machine();
    FrameBudget budget({.frame_ms = GetParam().budget_ms, .triangles = {}}, 0.25);
    const auto taus = run(budget, m, 600);
    EXPECT_GE(taus.front(), 4);
    for (std::size_t i = 1; i < taus.size(); ++i) {
        EXPECT_LE(taus[i], taus[i - 1] * 1.001) << "frame " << i;
        EXPECT_GE(taus[i], taus[i - 1] / 1.12) << "frame " << i;
        EXPECT_LE(m.mean_ms(taus[i]), GetParam().budget_ms) << "frame " << i;
    }
    EXPECT_GE(m.mean_ms(taus.back()), 0.84 * GetParam().budget_ms) << "too careful: tau " << taus.back();
    // From 8 pixels to the finest of these machines' in steps of 11 %.
    EXPECT_GE(m.mean_ms(taus[40]), 0.8 * GetParam().budget_ms) << "tau " << taus[40];
    EXPECT_TRUE(budget.at_rest());
}

TEST_P(Budgets, NearlyAllFramesKeepToTheirTimeHoweverTheyScatter) {
    for (const double noise : {0.02, 0.05, 0.1, 0.2}) {
        Machine m = machine();
        m.noise = noise;
        const double limit = GetParam().budget_ms;
        if (m.fixed_ms > limit / (1 + 3 * noise)) continue;  // there is no such tau
        FrameBudget budget({.frame_ms = limit, .triangles = {}}, 0.05);
        run(budget, m, 300);
        int beyond = 0;
        for (int i = 0; i < 1000; ++i) {
            const double tau = budget.tau_px();
            const FrameCost cost{m.ms(tau), static_cast<std::uint64_t>(m.triangles(tau))};
            beyond += budget.holds(cost) ? 0 : 1;
            budget.add(cost);
        }
        EXPECT_LE(beyond, 25) << "of 1000 frames that scatter by " << noise;
    }
}

TEST_P(Budgets, AMeshThatWillTakeTooLongIsNotDrawn) {
    Machine m = machine();
    FrameBudget budget({.frame_ms = GetParam().budget_ms, .triangles = {}}, 0.05);
    run(budget, m, 100);
    const double before = budget.tau_px();
    EXPECT_FALSE(budget.coarsen(static_cast<std::uint64_t>(m.triangles(before))));
    EXPECT_EQ(budget.tau_px(), before);
    m.count *= 4;  // the camera turns to the mountains
    EXPECT_TRUE(budget.coarsen(static_cast<std::uint64_t>(m.triangles(before))));
    EXPECT_GT(budget.tau_px(), 1.3 * before);
    EXPECT_LT(m.mean_ms(budget.tau_px()), 0.6 * m.mean_ms(before) + 0.6 * GetParam().budget_ms);
}

TEST_P(Budgets, FinerAgainWhenFramesGetCheapWithoutSwinging) {
    for (const bool plain : {true, false}) {
        Machine m = machine();
        FrameBudget budget({.frame_ms = GetParam().budget_ms, .triangles = {}}, 0.05);
        run(budget, m, 300);
        (plain ? m.count : m.variable_ms) /= 4;  // the camera turned to the plain; the machine is free again
        const auto taus = run(budget, m, 400);
        for (std::size_t i = 5; i < taus.size(); ++i)
            EXPECT_LE(taus[i], taus[i - 1] * 1.001) << "frame " << i << (plain ? " plain" : "");
        EXPECT_LE(m.mean_ms(taus.back()), GetParam().budget_ms);
        EXPECT_GE(m.mean_ms(taus.back()), 0.84 * GetParam().budget_ms);
    }
}

TEST_P(Budgets, CoarserWhenFramesGetDearWithoutSwinging) {
    for (const bool mountains : {true, false}) {
        Machine m = machine();
        FrameBudget budget({.frame_ms = GetParam().budget_ms, .triangles = {}}, 0.05);
        run(budget, m, 300);
        (mountains ? m.count : m.variable_ms) *= 4;
        const auto taus = run(budget, m, 400);
        for (std::size_t i = 1; i < taus.size(); ++i)
            EXPECT_GE(taus[i], taus[i - 1] * 0.999) << "frame " << i << (mountains ? " mountains" : "");
        EXPECT_LE(m.mean_ms(taus[60]), GetParam().budget_ms);
        EXPECT_GE(m.mean_ms(taus.back()), 0.8 * GetParam().budget_ms);
    }
}

TEST_P(Budgets, NoiseIsNotFollowed) {
    Machine m = machine();
    m.noise = 0.1;
    FrameBudget budget({.frame_ms = GetParam().budget_ms, .triangles = {}}, 0.25);
    run(budget, m, 200);
    const auto taus = run(budget, m, 1000);
    double sum = 0;
    double sum2 = 0;
    int kept = 0;
    for (const double tau : taus) {
        sum += std::log(tau);
        sum2 += std::log(tau) * std::log(tau);
        kept += m.mean_ms(tau) <= 1.05 * GetParam().budget_ms;
    }
    const double mean = sum / 1000;
    EXPECT_LT(std::sqrt(sum2 / 1000 - mean * mean), 0.2) << "spread of ln tau";
    EXPECT_GE(kept, 900) << "frames of 1000 whose expected time is within 5 % of the limit";
}

TEST_P(Budgets, OneSlowFrameIsNotSeen) {
    Machine m = machine();
    FrameBudget budget({.frame_ms = GetParam().budget_ms, .triangles = {}}, 0.25);
    run(budget, m, 300);
    const double before = budget.tau_px();
    budget.add({50 * GetParam().budget_ms, static_cast<std::uint64_t>(m.triangles(before))});
    for (int i = 0; i < 50; ++i) {
        EXPECT_NEAR(budget.tau_px(), before, 0.12 * before) << i;
        run(budget, m, 1);
    }
}

INSTANTIATE_TEST_SUITE_P(Machines, Budgets,
                         testing::Values(Case{0, 40, 1.5, 16}, Case{20, 40, 1.5, 33}, Case{20, 40, 1.2, 33},
                                         Case{5, 100, 1.9, 20}, Case{1, 10, 1.1, 8}, Case{24, 40, 1.6, 30}));

TEST(FrameBudget, NeverFinerThanTheUsersTauNorCoarserThanTheCoarsest) {
    Machine m;
    FrameBudget rich({.frame_ms = 1e6, .triangles = {}}, 0.7);
    run(rich, m, 40);  // it begins coarse
    for (const double tau : run(rich, m, 100)) EXPECT_EQ(tau, 0.7);
    FrameBudget poor({.frame_ms = 1, .triangles = {}}, 0.7);  // less than the fixed part
    const auto taus = run(poor, m, 200);
    EXPECT_TRUE(std::is_sorted(taus.begin(), taus.end()));
    EXPECT_DOUBLE_EQ(taus.back(), FrameBudget::kCoarsestPx);
    FrameBudget coarse({.frame_ms = 1, .triangles = {}}, 100);  // the user's is coarser already
    for (const double tau : run(coarse, m, 10)) EXPECT_EQ(tau, 100);
}

TEST(FrameBudget, TauGrowsUntilTheTerrainFitsInItsMemory) {
    FrameBudget budget({}, 0.5);
    const auto memory_at = [](double tau) { return 3 * std::pow(tau, -1.2); };  // too much below 2.6 pixels
    std::vector<double> taus;
    for (int i = 0; i < 100; ++i) {
        taus.push_back(budget.tau_px());
        budget.add({10, 1000, memory_at(taus.back())});
    }
    EXPECT_EQ(taus.front(), 0.5);
    EXPECT_TRUE(std::is_sorted(taus.begin(), taus.end()));
    EXPECT_LE(memory_at(taus.back()), 1);
    EXPECT_GE(memory_at(taus.back()), 0.85);
    EXPECT_TRUE(budget.at_rest());
    for (int i = 0; i < 100; ++i) budget.add({10, 1000, 0.1});
    EXPECT_EQ(budget.tau_px(), 0.5);
}

TEST(FrameBudget, TheUsersTauMayChangeOnTheWay) {
    Machine m;
    FrameBudget budget({.frame_ms = 33, .triangles = {}}, 0.25);
    run(budget, m, 300);
    const double reached = budget.tau_px();
    ASSERT_GT(reached, 1);
    budget.set_finest(reached * 4);
    EXPECT_DOUBLE_EQ(budget.tau_px(), reached * 4);
    run(budget, m, 100);
    EXPECT_EQ(budget.tau_px(), reached * 4);
    budget.set_finest(0.5);
    run(budget, m, 300);
    EXPECT_NEAR(budget.tau_px(), reached, 0.15 * reached);
}

TEST(FrameBudget, HoldsANumberOfTrianglesOneWay) {
    for (const double power : {1.1, 1.5, 1.9}) {
        Machine m;
        m.power = power;
        m.noise = 0.3;  // of times, which do not matter here
        FrameBudget budget({.frame_ms = {}, .triangles = 20000}, 0.25);
        const auto taus = run(budget, m, 100);
        EXPECT_TRUE(std::is_sorted(taus.begin(), taus.end())) << power;
        EXPECT_LE(m.triangles(taus[40]), 20000) << power;
        EXPECT_GE(m.triangles(taus.back()), 0.8 * 20000) << power;
    }
}

TEST(FrameBudget, OfTwoLimitsTheStricterCounts) {
    Machine m;
    FrameBudget budget({.frame_ms = 33, .triangles = 5000}, 0.25);
    run(budget, m, 300);
    EXPECT_LE(m.triangles(budget.tau_px()), 5000);
    EXPECT_GE(m.triangles(budget.tau_px()), 4000);
    FrameBudget other({.frame_ms = 33, .triangles = 1000000}, 0.25);
    run(other, m, 300);
    EXPECT_LE(m.mean_ms(other.tau_px()), 33);
    EXPECT_GE(m.mean_ms(other.tau_px()), 27);
    EXPECT_TRUE(budget.holds({33, 5000}));
    EXPECT_FALSE(budget.holds({33.1, 5000}));
    EXPECT_FALSE(budget.holds({33, 5001}));
}

TEST(FrameBudget, FindsTheTauOfAStillPicture) {
    const Machine m;
    const auto count = [&](double tau) { return static_cast<std::uint64_t>(m.triangles(tau)); };
    EXPECT_EQ(tau_for_triangles(1000000, 0.5, count), 0.5);
    const double tau = tau_for_triangles(20000, 0.5, count);
    EXPECT_NEAR(tau, std::pow(5, 1 / 1.5), 0.011 * tau);
    EXPECT_LE(count(tau), 20000u);
    EXPECT_EQ(tau_for_triangles(1, 0.5, count), FrameBudget::kCoarsestPx);
    EXPECT_EQ(tau_for_triangles(1, 100, count), 100);
}

}  // namespace
}  // namespace relevo::viewer
