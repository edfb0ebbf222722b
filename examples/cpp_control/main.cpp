// A two-link arm held by a PD controller with gravity compensation, from the C that robot-model emits.
//
// The controller knows a model; the plant is the same model's forward dynamics, stepped at 1 kHz. With gravity compensated the
// arm comes to rest where it is told to, without it sags.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "two_link_arm.h"

namespace {

using Joints = std::array<double, TWO_LINK_ARM_DOF>;
using Beta = std::array<double, TWO_LINK_ARM_BASE>;

constexpr double STEP_S = 1e-3;
constexpr int STEPS = 4000;

/// Where a standard parameter stands.
int place(const char *name) {
    for (int k = 0; k < TWO_LINK_ARM_STANDARD; ++k) {
        if (std::strcmp(two_link_arm_standard_parameter_names[k], name) == 0) {
            return k;
        }
    }
    std::printf("no parameter %s\n", name);
    std::abort();
}

/// Two slender rods with some friction in their joints; frames are at the far ends of the links.
Beta rods() {
    std::array<double, TWO_LINK_ARM_STANDARD> standard{};
    standard[place("shoulder.m")] = 4.0;
    standard[place("shoulder.mx")] = -4.0 * 0.25;
    standard[place("shoulder.izz")] = 4.0 * 0.5 * 0.5 / 3.0;
    standard[place("elbow.m")] = 2.0;
    standard[place("elbow.mx")] = -2.0 * 0.2;
    standard[place("elbow.izz")] = 2.0 * 0.4 * 0.4 / 3.0;
    standard[place("shoulder.viscous_friction.fv")] = 1.5;
    standard[place("elbow.viscous_friction.fv")] = 0.6;
    Beta beta;
    two_link_arm_base_parameters(standard.data(), beta.data());
    return beta;
}

/// `tau = Kp (wanted - q) - Kd dq`, and `G(q)` on top of it.
Joints control(const Beta &beta, const Joints &wanted, const Joints &q, const Joints &dq, bool compensates) {
    constexpr Joints KP = {120.0, 60.0};
    constexpr Joints KD = {30.0, 8.0};
    Joints tau{};
    if (compensates) {
        two_link_arm_gravity(q.data(), beta.data(), tau.data());
    }
    for (int j = 0; j < TWO_LINK_ARM_DOF; ++j) {
        tau[j] += KP[j] * (wanted[j] - q[j]) - KD[j] * dq[j];
    }
    return tau;
}

/// Distance to the wanted pose after four seconds, rad; negative where the equations had no solution.
double held(const Beta &beta, const Joints &wanted, bool compensates) {
    Joints q{};
    Joints dq{};
    for (int step = 0; step < STEPS; ++step) {
        const Joints tau = control(beta, wanted, q, dq, compensates);
        Joints ddq;
        if (!two_link_arm_forward_dynamics(q.data(), dq.data(), tau.data(), beta.data(), ddq.data())) {
            return -1.0;
        }
        for (int j = 0; j < TWO_LINK_ARM_DOF; ++j) {
            dq[j] += STEP_S * ddq[j];
            q[j] += STEP_S * dq[j];
        }
    }
    return std::hypot(wanted[0] - q[0], wanted[1] - q[1]);
}

}  // namespace

int main() {
    const Beta beta = rods();
    const Joints wanted = {0.9, -0.6};
    const double with = held(beta, wanted, true);
    const double without = held(beta, wanted, false);
    double poses[TWO_LINK_ARM_DOF][4][4];
    two_link_arm_forward_kinematics(wanted.data(), poses);
    std::printf("%s at x = %.3f m, y = %.3f m\n", TWO_LINK_ARM_NAME, poses[1][0][3], poses[1][1][3]);
    std::printf("off by %.1e rad with gravity compensation, by %.2f rad without\n", with, without);
    return with >= 0.0 && with < 1e-3 && without > 0.1 ? 0 : 1;
}
