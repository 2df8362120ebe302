// Runs one scheme of the study some times over, with Eigen and Boost.odeint, and prints how long each run took:
//
//     peer proposed|tang_arteaga|slotine_li REPETITIONS [STEPS_PER_MS]
//
// 12 s, by default with steps of 1 ms. The rows printed beside the times are for checking that what was timed is right.
#include "closed_loop.hpp"

#include <boost/numeric/odeint/algebra/default_operations.hpp>
#include <boost/numeric/odeint/algebra/vector_space_algebra.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/version.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#ifdef __clang__
constexpr const char* COMPILER = "";
#else
constexpr const char* COMPILER = "g++";
#endif

constexpr int DURATION_MS = 12000, MS_PER_ROW = 480;

/// odeint's own sum at the end of a step rounds the state after every increment. Where the projection holds an estimate at an
/// equilibrium, that leaves it beside it; adding the increments up first does not, and costs nothing.
struct IncrementsFirst : boost::numeric::odeint::default_operations {
    template <class Fac1 = double, class Fac2 = Fac1>
    struct scale_sum5 {
        Fac1 a1;
        Fac2 a2, a3, a4, a5;
        scale_sum5(Fac1 a1, Fac2 a2, Fac2 a3, Fac2 a4, Fac2 a5) : a1(a1), a2(a2), a3(a3), a4(a4), a5(a5) {}

        template <class State>
        void operator()(State& sum, const State& x, const State& k1, const State& k2, const State& k3, const State& k4) const {
            sum = a1 * x + (a2 * k1 + a3 * k2 + a4 * k3 + a5 * k4);
        }
        using result_type = void;
    };
};

struct Row {
    double time_s;
    Vec3 q, dq, error;
    Parameters theta_hat;
};

template <Scheme scheme>
std::vector<Row> run(int steps_per_ms) {
    using Loop = ClosedLoop<scheme>;
    using State = typename Loop::State;
    namespace odeint = boost::numeric::odeint;
    odeint::runge_kutta4<State, double, State, double, odeint::vector_space_algebra, IncrementsFirst> stepper;
    Loop loop;
    State x = loop.initial_state();
    const double step_s = 1e-3 / steps_per_ms;
    const int steps = DURATION_MS * steps_per_ms, steps_per_row = MS_PER_ROW * steps_per_ms;
    std::vector<Row> rows;
    rows.reserve(DURATION_MS / MS_PER_ROW);
    for (int n = 0; n < steps; ++n) {
        stepper.do_step(std::ref(loop), x, n * step_s, step_s);
        if ((n + 1) % steps_per_row == 0) {
            const double t = (n + 1) * step_s;
            const Vec3 q = x.template head<3>();
            rows.push_back({t, q, x.template segment<3>(3), q - desired_motion(t).q, Loop::theta_hat(x)});
        }
    }
    return rows;
}

template <class Vector>
void print(const char* name, const Vector& v) {
    std::printf(", \"%s\": [", name);
    for (int i = 0; i < v.size(); ++i) std::printf("%s%.17g", i ? ", " : "", v[i]);
    std::printf("]");
}

template <Scheme scheme>
void time_runs(const char* name, int repetitions, int steps_per_ms) {
    std::vector<double> seconds;
    std::vector<Row> rows;
    for (int n = 0; n < repetitions; ++n) {
        const auto start = std::chrono::steady_clock::now();
        rows = run<scheme>(steps_per_ms);
        seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    std::printf("{\"scheme\": \"%s\", \"steps\": %d", name,
                DURATION_MS * steps_per_ms);
    std::printf(", \"with\": \"Eigen %d.%d.%d, Boost %s, %s %s\"", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION,
                EIGEN_MINOR_VERSION, BOOST_LIB_VERSION, COMPILER, __VERSION__);
    print("seconds", Eigen::Map<Eigen::VectorXd>(seconds.data(), seconds.size()));
    std::printf(", \"rows\": [");
    for (const Row& row : rows) {
        std::printf("%s{\"t_s\": %.17g", &row == rows.data() ? "" : ", ", row.time_s);
        print("q", row.q), print("dq", row.dq), print("e", row.error), print("theta_hat", row.theta_hat);
        std::printf("}");
    }
    std::printf("]}\n");
}

int main(int count, char** arguments) {
    const std::string scheme = count > 1 ? arguments[1] : "";
    const int repetitions = count > 2 ? std::atoi(arguments[2]) : 0;
    const int steps_per_ms = count > 3 ? std::atoi(arguments[3]) : 1;
    if (repetitions >= 1 && steps_per_ms >= 1) {
        if (scheme == "proposed") return time_runs<Scheme::Proposed>("proposed", repetitions, steps_per_ms), 0;
        if (scheme == "tang_arteaga") return time_runs<Scheme::TangArteaga>("tang_arteaga", repetitions, steps_per_ms), 0;
        if (scheme == "slotine_li") return time_runs<Scheme::SlotineLi>("slotine_li", repetitions, steps_per_ms), 0;
    }
    std::fprintf(stderr, "usage: peer proposed|tang_arteaga|slotine_li REPETITIONS [STEPS_PER_MS]\n");
    return 2;
}
