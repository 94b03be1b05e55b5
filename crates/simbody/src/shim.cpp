// A planar linkage as a Simbody system: all motion in the plane z = 0, pins and sliders on a spanning tree,
// loops closed by constraints. See shim.h for units and signs.

#include "shim.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <Simbody.h>

using namespace SimTK;

namespace {

Vec3 in_plane(const double of[2]) { return Vec3(of[0], of[1], 0); }

void out_of(const Vec3 &vector, double to[2]) {
    to[0] = vector[0];
    to[1] = vector[1];
}

// A coordinate as a linear function of time. The position is prescribed (not the rate), so the coordinate has no
// integration error.
class Uniform : public Motion::Custom::Implementation {
public:
    Uniform(double start, double rate) : start(start), rate(rate) {}
    Implementation *clone() const override { return new Uniform(*this); }
    Motion::Level getLevel(const State &) const override { return Motion::Position; }
    void calcPrescribedPosition(const State &state, int, Real *q) const override { *q = start + rate * state.getTime(); }
    void calcPrescribedPositionDot(const State &, int, Real *qdot) const override { *qdot = rate; }
    void calcPrescribedPositionDotDot(const State &, int, Real *qdotdot) const override { *qdotdot = 0; }

private:
    double start, rate;
};

// Moment of constant magnitude against the rotation of a body.
class Resistance : public Force::Custom::Implementation {
public:
    Resistance(const MobilizedBody &body, double moment) : body(body), moment(moment) {}
    bool dependsOnlyOnPositions() const override { return false; }
    void calcForce(const State &state, Vector_<SpatialVec> &forces, Vector_<Vec3> &, Vector &) const override {
        const double omega = body.getBodyAngularVelocity(state)[2];
        const double sense = omega > 0 ? 1.0 : omega < 0 ? -1.0 : 0.0;
        body.applyBodyTorque(state, Vec3(0, 0, -moment * sense), forces);
    }
    Real calcPotentialEnergy(const State &) const override { return 0; }

private:
    MobilizedBody body;
    double moment;
};

void motion(const State &state, const MobilizedBody &body, linkproof_body_state &to) {
    to.coordinate = body.getOneQ(state, 0);
    to.rate = body.getOneU(state, 0);
    out_of(body.getBodyOriginLocation(state), to.origin);
    out_of(body.getBodyRotation(state).x(), to.direction);
    out_of(body.getBodyOriginVelocity(state), to.velocity);
    to.omega = body.getBodyAngularVelocity(state)[2];
}

// Forces and moments on the bodies from the caller's function.
class Acting : public Force::Custom::Implementation {
public:
    Acting(const std::vector<MobilizedBody> &bodies, const std::vector<Vec3> &centres, linkproof_act act, void *user)
        : bodies(bodies), centres(centres), act(act), user(user) {}
    bool dependsOnlyOnPositions() const override { return false; }
    void calcForce(const State &state, Vector_<SpatialVec> &forces, Vector_<Vec3> &, Vector &) const override {
        std::vector<linkproof_body_state> states(bodies.size());
        std::vector<double> loads(3 * bodies.size(), 0.0);
        for (size_t index = 0; index < bodies.size(); ++index)
            motion(state, bodies[index], states[index]);
        act(user, states.data(), loads.data());
        for (size_t index = 0; index < bodies.size(); ++index) {
            const double *load = &loads[3 * index];
            bodies[index].applyForceToBodyPoint(state, centres[index], Vec3(load[0], load[1], 0), forces);
            bodies[index].applyBodyTorque(state, Vec3(0, 0, load[2]), forces);
        }
    }
    Real calcPotentialEnergy(const State &) const override { return 0; }

private:
    std::vector<MobilizedBody> bodies;
    std::vector<Vec3> centres;
    linkproof_act act;
    void *user;
};

// Rotation about z from the direction (cos, sin), without computing the angle.
Rotation turn(const double axis[2]) { return Rotation(UnitVec3(axis[0], axis[1], 0), XAxis, Vec3(0, 0, 1), ZAxis); }

struct Loop {
    Constraint::PointInPlane along[2];
};

// Copies a text to the caller's buffer. A text longer than the buffer is cut.
int told(const std::string &what, char *text, size_t size) {
    if (size > 0) {
        const size_t length = std::min(what.size(), size - 1);
        std::memcpy(text, what.data(), length);
        text[length] = 0;
    }
    return 1;
}

template <class Action> int guarded(char *text, size_t size, Action action) noexcept {
    try {
        action();
        return 0;
    } catch (const std::exception &error) {
        return told(error.what(), text, size);
    } catch (...) {
        return told("an exception that is no std::exception", text, size);
    }
}

} // namespace

struct linkproof_run {
    MultibodySystem system;
    SimbodyMatterSubsystem matter;
    GeneralForceSubsystem forces;
    Force::DiscreteForces relief;
    RungeKuttaMersonIntegrator integrator;
    Vec3 gravity;
    std::vector<linkproof_body> given;
    std::vector<double> loads; // For each body: force at the mass centre (two numbers), moment about the mass centre.
    std::vector<MobilizedBody> bodies; // The ground is first.
    std::vector<Loop> loops;

    linkproof_run(const linkproof_body *first, size_t count, const Vec3 &gravity, linkproof_act act, void *user)
        : matter(system), forces(system), relief(forces, matter), integrator(system), gravity(gravity),
          given(first, first + count), loads(3 * count, 0.0) {
        Force::UniformGravity(forces, matter, gravity);
        bodies.push_back(matter.updGround());
        for (const linkproof_body &body : given)
            hang(body);
        if (act) {
            std::vector<Vec3> centres;
            for (const linkproof_body &body : given)
                centres.push_back(in_plane(body.centre));
            Force::Custom(forces, new Acting(std::vector<MobilizedBody>(bodies.begin() + 1, bodies.end()), centres, act, user));
        }
    }

    void hang(const linkproof_body &body) {
        const double mass = body.mass + body.extra_mass, inertia = body.inertia + body.extra_inertia;
        const Vec3 centre = in_plane(body.centre);
        // Nothing turns out of the plane; equal moments of inertia are valid for any body.
        const MassProperties properties(mass, centre, Inertia(inertia).shiftFromMassCenter(centre, mass));
        MobilizedBody &parent = bodies.at(body.parent);
        const Vec3 on_parent = in_plane(body.on_parent), on_child = in_plane(body.on_child);
        if (body.slides) {
            MobilizedBody::Slider slider(parent, Transform(turn(body.axis_parent), on_parent), Body::Rigid(properties),
                                         Transform(turn(body.axis_child), on_child));
            slider.setDefaultQ(body.coordinate);
            bodies.push_back(slider);
        } else {
            MobilizedBody::Pin pin(parent, Transform(on_parent), Body::Rigid(properties), Transform(on_child));
            pin.setDefaultQ(body.coordinate);
            bodies.push_back(pin);
        }
        if (body.driven)
            Motion::Custom(bodies.back(), new Uniform(body.coordinate, body.rate));
        if (body.resistance != 0)
            Force::Custom(forces, new Resistance(bodies.back(), body.resistance));
    }

    // Two equations in the plane. An equation for z would be redundant, because no mobilizer leaves the plane.
    void close(const linkproof_loop &loop) {
        Loop closed;
        const Vec3 place = in_plane(loop.on_first);
        for (int axis = 0; axis < 2; ++axis) {
            const UnitVec3 normal = UnitVec3(axis == 0, axis == 1, 0);
            closed.along[axis] = Constraint::PointInPlane(bodies.at(loop.first), normal, place[axis],
                                                          bodies.at(loop.second), in_plane(loop.on_second));
        }
        loops.push_back(closed);
    }

    void start(double accuracy, double tolerance) {
        State state = system.realizeTopology();
        system.realizeModel(state);
        for (size_t index = 0; index < given.size(); ++index)
            if (!given[index].driven)
                bodies[index + 1].setOneU(state, 0, given[index].rate);
        integrator.setAccuracy(accuracy);
        integrator.setConstraintTolerance(tolerance);
        integrator.setUseInfinityNorm(true);
        integrator.setProjectEveryStep(true);
        // Without interpolation every requested time ends a step.
        integrator.setAllowInterpolation(false);
        integrator.initialize(state);
    }

    void advance(double time, size_t steps) {
        const size_t before = taken();
        // The loop does nothing for a time that has already been reached, such as the start.
        while (integrator.getAdvancedTime() < time) {
            integrator.setInternalStepLimit(100);
            integrator.stepTo(time);
            if (taken() - before > steps)
                throw std::runtime_error("more than " + std::to_string(steps) + " internal steps to the next instant");
            if (integrator.isSimulationOver())
                throw std::runtime_error("the integrator has ended the simulation");
        }
    }

    size_t taken() const { return static_cast<size_t>(integrator.getNumStepsAttempted()); }

    // Applies two kinds of forces: the loads, and forces that accelerate the extra masses in place of the mobilizers.
    // The forces for the extra masses follow from the accelerations.
    // The accelerations depend on neither kind of force, because every degree of freedom is prescribed.
    void relieve(State &state) const {
        // All accelerations are read before any force is set, because setting a force invalidates the accelerations.
        std::vector<SpatialVec> carried(given.size(), SpatialVec(Vec3(0)));
        for (size_t index = 0; index < given.size(); ++index) {
            const linkproof_body &body = given[index];
            const MobilizedBody &mobile = bodies[index + 1];
            const Vec3 centre = in_plane(body.centre);
            const Vec3 arm = mobile.getBodyRotation(state) * centre;
            const Vec3 force = (mobile.findStationAccelerationInGround(state, centre) - gravity) * body.extra_mass +
                               Vec3(loads[3 * index], loads[3 * index + 1], 0);
            const Vec3 torque = mobile.getBodyAngularAcceleration(state) * body.extra_inertia +
                                Vec3(0, 0, loads[3 * index + 2]) + arm % force;
            carried[index] = SpatialVec(torque, force);
        }
        for (size_t index = 0; index < given.size(); ++index) {
            const double *load = &loads[3 * index];
            if (given[index].extra_mass != 0 || given[index].extra_inertia != 0 || load[0] != 0 || load[1] != 0 || load[2] != 0)
                relief.setOneBodyForce(state, bodies[index + 1], carried[index]);
        }
    }

    void read(bool reactions, linkproof_body_state *of_bodies, linkproof_loop_state *of_loops) {
        State state = integrator.getAdvancedState();
        system.realize(state, Stage::Acceleration);
        Vector_<SpatialVec> at_joints(matter.getNumBodies(), SpatialVec(Vec3(0)));
        Vector drives(state.getNU(), 0.0);
        for (size_t index = 0; index < given.size(); ++index)
            moved(state, bodies[index + 1], of_bodies[index]);
        if (reactions) {
            relieve(state);
            system.realize(state, Stage::Acceleration);
            matter.calcMobilizerReactionForces(state, at_joints);
            matter.findMotionForces(state, drives);
        }
        for (size_t index = 0; index < given.size(); ++index) {
            const MobilizedBody &mobile = bodies[index + 1];
            const SpatialVec &reaction = at_joints[mobile.getMobilizedBodyIndex()];
            out_of(reaction[1], of_bodies[index].force);
            of_bodies[index].moment = reaction[0][2];
            // Motion forces are on the left side of the equations of motion, like multipliers, so the sign is reversed.
            of_bodies[index].drive = -mobile.getOneFromUPartition(state, 0, drives);
        }
        for (size_t index = 0; index < loops.size(); ++index) {
            of_loops[index].gap = gap(state, loops[index]);
            Vec3 force(0);
            for (int axis = 0; reactions && axis < 2; ++axis) {
                const Constraint::PointInPlane &plane = loops[index].along[axis];
                const MobilizedBody &first = matter.getMobilizedBody(plane.getPlaneMobilizedBodyIndex());
                // A multiplier is on the left side of the equations of motion, so the force has the opposite sign.
                // (3.7 declares getForceOnFollowerPoint, but the library does not contain it.)
                force -= first.getBodyRotation(state) * (plane.getDefaultPlaneNormal() * plane.getMultiplier(state));
            }
            out_of(force, of_loops[index].force);
        }
    }

    static void moved(const State &state, const MobilizedBody &body, linkproof_body_state &to) {
        motion(state, body, to);
        out_of(body.getBodyOriginAcceleration(state), to.acceleration);
        to.alpha = body.getBodyAngularAcceleration(state)[2];
    }

    static double gap(const State &state, const Loop &loop) {
        return std::hypot(loop.along[0].getPositionError(state), loop.along[1].getPositionError(state));
    }

    void gaps(double *time, double *of_loops) {
        State state = integrator.getAdvancedState();
        system.realize(state, Stage::Position);
        *time = state.getTime();
        for (size_t index = 0; index < loops.size(); ++index)
            of_loops[index] = gap(state, loops[index]);
    }
};

int linkproof_simbody_new(const linkproof_body *bodies, size_t body_count, const linkproof_loop *loops, size_t loop_count,
                          const double gravity[2], double accuracy, double tolerance, double time_scale,
                          linkproof_act act, void *user, linkproof_run **run, char *text, size_t size) {
    *run = nullptr;
    return guarded(text, size, [&] {
        std::unique_ptr<linkproof_run> made(new linkproof_run(bodies, body_count, in_plane(gravity), act, user));
        for (size_t index = 0; index < loop_count; ++index)
            made->close(loops[index]);
        made->system.setDefaultTimeScale(time_scale);
        made->start(accuracy, tolerance);
        *run = made.release();
    });
}

int linkproof_simbody_advance(linkproof_run *run, double time, size_t steps, char *text, size_t size) {
    return guarded(text, size, [&] { run->advance(time, steps); });
}

int linkproof_simbody_read(linkproof_run *run, int reactions, linkproof_body_state *bodies, linkproof_loop_state *loops,
                           char *text, size_t size) {
    return guarded(text, size, [&] { run->read(reactions != 0, bodies, loops); });
}

void linkproof_simbody_load(linkproof_run *run, const double *loads) {
    std::copy(loads, loads + run->loads.size(), run->loads.begin());
}

int linkproof_simbody_gaps(linkproof_run *run, double *time, double *gaps, char *text, size_t size) {
    return guarded(text, size, [&] { run->gaps(time, gaps); });
}

size_t linkproof_simbody_steps(const linkproof_run *run) { return run->taken(); }

void linkproof_simbody_free(linkproof_run *run) { delete run; }

void linkproof_simbody_version(int version[3]) { SimTK_version_simbody(&version[0], &version[1], &version[2]); }

void linkproof_simbody_sizes(size_t sizes[4]) {
    sizes[0] = sizeof(linkproof_body);
    sizes[1] = sizeof(linkproof_loop);
    sizes[2] = sizeof(linkproof_body_state);
    sizes[3] = sizeof(linkproof_loop_state);
}
