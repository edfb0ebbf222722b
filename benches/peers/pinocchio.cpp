// Pinocchio's algorithms on an arm of numbers, in its C++; header-only. One program for all arms: `arm.txt` stands beside it.
#include <fstream>
#include <stdexcept>
#include <string>

#include <pinocchio/multibody.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include "contender.h"

namespace {

using Column = Eigen::VectorXd;
using In = Eigen::Map<const Column>;
using Rows = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

pinocchio::Model model;
pinocchio::Data data;
Column q_, dq_, ddq_;
Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> map;

// Pinocchio takes no maps as states; a copy of a few numbers is less than one joint of its recursion.
void state(const double *q, const double *dq, const double *ddq) {
    q_ = In(q, joints);
    dq_ = In(dq, joints);
    ddq_ = In(ddq, joints);
}

void inverse_dynamics(const double *q, const double *dq, const double *ddq, const double *, double *out) {
    state(q, dq, ddq);
    Eigen::Map<Column>(out, joints) = pinocchio::rnea(model, data, q_, dq_, ddq_);
}

void mass_matrix(const double *q, const double *dq, const double *ddq, const double *, double *out) {
    state(q, dq, ddq);
    Rows(out, joints, joints) = pinocchio::crba(model, data, q_, pinocchio::Convention::WORLD).selfadjointView<Eigen::Upper>();
}

void coriolis_matrix(const double *q, const double *dq, const double *ddq, const double *, double *out) {
    state(q, dq, ddq);
    Rows(out, joints, joints) = pinocchio::computeCoriolisMatrix(model, data, q_, dq_);
}

void gravity(const double *q, const double *dq, const double *ddq, const double *, double *out) {
    state(q, dq, ddq);
    Eigen::Map<Column>(out, joints) = pinocchio::computeGeneralizedGravity(model, data, q_);
}

void regressor(const double *q, const double *dq, const double *ddq, const double *, double *out) {
    state(q, dq, ddq);
    Rows(out, joints, 10 * joints) = pinocchio::computeJointTorqueRegressor(model, data, q_, dq_, ddq_);
}

} // namespace

extern "C" {

int joints = 0;

struct contender contenders[] = {
    {"inverse_dynamics", 0, 0, inverse_dynamics, 0, 0},
    {"mass_matrix", 0, 0, mass_matrix, 0, 0},
    {"coriolis_matrix", 0, 0, coriolis_matrix, 0, 0},
    {"gravity", 0, 0, gravity, 0, 0},
    {"regressor", 0, 0, regressor, 0, 0},
    {0, 0, 0, 0, 0, 0},
};

void prepare(const char *program) {
    std::string path = program;
    std::ifstream file(path.substr(0, path.rfind('/') + 1) + "arm.txt");
    file >> joints;
    for (int k = 0; k < 3; k++) file >> model.gravity.linear()[k];
    pinocchio::JointIndex parent = 0;
    for (int k = 0; k < joints; k++) {
        Eigen::Vector3d axis, p, c;
        Eigen::Matrix3d R, I;
        double m;
        auto vector = [&](auto &v) { for (int i = 0; i < 3; i++) file >> v[i]; };
        auto matrix = [&](auto &A) { for (int i = 0; i < 3; i++) for (int j = 0; j < 3; j++) file >> A(i, j); };
        vector(axis), matrix(R), vector(p), file >> m, vector(c), matrix(I);
        if (!file) throw std::runtime_error("no arm in arm.txt");
        pinocchio::SE3 placement(R, p);
        std::string name = "joint" + std::to_string(k);
        if (axis[0] == 1) parent = model.addJoint(parent, pinocchio::JointModelRX(), placement, name);
        else if (axis[1] == 1) parent = model.addJoint(parent, pinocchio::JointModelRY(), placement, name);
        else if (axis[2] == 1) parent = model.addJoint(parent, pinocchio::JointModelRZ(), placement, name);
        else parent = model.addJoint(parent, pinocchio::JointModelRevoluteUnaligned(axis), placement, name);
        model.inertias[parent] = pinocchio::Inertia(m, c, pinocchio::Symmetric3(I));
    }
    data = pinocchio::Data(model);
    for (struct contender &f : contenders) f.outputs = joints;
    contenders[1].outputs = contenders[2].outputs = joints * joints;
    contenders[4].outputs = 10 * joints * joints;
    map.resize(10 * joints, 10 * joints);
    for (int i = 0; i < map.rows(); i++)
        for (int j = 0; j < map.cols(); j++) file >> map(i, j);
    if (!file) throw std::runtime_error("no map in arm.txt");
    contenders[4].map = map.data();
    contenders[4].columns = static_cast<int>(map.cols());
    q_.resize(joints), dq_.resize(joints), ddq_.resize(joints);
}
}
