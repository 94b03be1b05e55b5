/* The C side of linkproof-simbody: a planar linkage as a Simbody system.
 * All units are SI; angles are in rad, counter-clockwise positive.
 * No exception leaves these functions. src/ffi.rs repeats every declaration of this file. */
#ifndef LINKPROOF_SIMBODY_SHIM_H
#define LINKPROOF_SIMBODY_SHIM_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A body and the mobilizer that connects it to its parent. Bodies are numbered from 1, the ground is 0.
 * A parent has a smaller number than its child.
 * Positions and axes are given in the frame of the body they belong to. */
typedef struct linkproof_body {
    size_t parent;
    int slides;            /* 0: pin, its coordinate is the child's angle minus the parent's; otherwise slider. */
    double on_parent[2];   /* Position of the joint on the parent, then on the child. */
    double on_child[2];
    double axis_parent[2]; /* Unit vectors of a slider's axis; the coordinate is the distance from the parent's
                            * point along this axis. */
    double axis_child[2];
    double mass;
    double centre[2];
    double inertia;        /* About the mass centre. */
    double extra_mass;     /* Additional mass at the same centre. Reactions do not contain its effect. */
    double extra_inertia;
    double resistance;     /* Moment against the rotation, zero at rest. */
    double coordinate;     /* Coordinate of the mobilizer at time 0. */
    int driven;            /* Whether the coordinate is prescribed: coordinate + rate * time. */
    double rate;           /* Rate of the coordinate: prescribed, or at time 0. */
} linkproof_body;

/* A revolute joint between two bodies of the tree. */
typedef struct linkproof_loop {
    size_t first;
    size_t second;
    double on_first[2];
    double on_second[2];
} linkproof_loop;

/* State of a body, in world axes. Force, moment and drive are zero if reactions were not requested. */
typedef struct linkproof_body_state {
    double coordinate;
    double rate;         /* Of the coordinate. */
    double origin[2];
    double direction[2]; /* Unit vector of the x axis of the body's frame. */
    double velocity[2];
    double omega;
    double acceleration[2];
    double alpha;
    double force[2];     /* Force of the mobilizer on the body. */
    double moment;       /* Moment of the mobilizer on the body, about the joint's point on the body.
                          * It includes the driving moment. */
    double drive;        /* Generalised force of the prescribed motion. */
} linkproof_body_state;

typedef struct linkproof_loop_state {
    double force[2]; /* Force of the first body on the second. */
    double gap;      /* Distance between the two points. */
} linkproof_loop_state;

typedef struct linkproof_run linkproof_run;

/* Computes the loads on the bodies during the run, without gravity.
 * The input has positions and velocities of all bodies; accelerations and forces are zero.
 * The output is, for every body, the force at its mass centre (N, world axes) and the moment about its
 * mass centre (N m).
 * The function must not throw. */
typedef void (*linkproof_act)(void *user, const linkproof_body_state *bodies, double *loads);

/* Texts are cut to `size` bytes, including the final zero.
 * A function of type `int` returns 0 or, on failure, 1 and a text. */

/* Builds the system and assembles it to `tolerance` (m).
 * No constraint error exceeds `tolerance`, and neither does its rate times `time_scale` (s).
 * `accuracy` is that of the integrator.
 * If `act` is null, only gravity and the resistances of the bodies act. `act` is called with `user` as long as the run
 * exists. */
int linkproof_simbody_new(const linkproof_body *bodies, size_t body_count, const linkproof_loop *loops, size_t loop_count,
                          const double gravity[2], double accuracy, double tolerance, double time_scale,
                          linkproof_act act, void *user, linkproof_run **run, char *text, size_t size);

/* Integrates to `time`, in at most `steps` internal steps. `time` must not lie before the time already reached. */
int linkproof_simbody_advance(linkproof_run *run, double time, size_t steps, char *text, size_t size);

/* Reads the present state; with `reactions`, also forces.
 * The arrays have as many entries as there are bodies and loops. */
int linkproof_simbody_read(linkproof_run *run, int reactions, linkproof_body_state *bodies, linkproof_loop_state *loops,
                           char *text, size_t size);

/* Sets the loads on the bodies. Reactions that are read afterwards include these loads.
 * `loads` has three numbers for each body: the force at the mass centre (N, world axes) and the moment about the mass
 * centre (N m). Initially all loads are zero.
 * Loads are used only when reactions are read, so the reactions are correct only if every degree of freedom is
 * prescribed. */
void linkproof_simbody_load(linkproof_run *run, const double *loads);

/* Time that the integrator has reached, also after a failure, and the gap of every loop at that time. */
int linkproof_simbody_gaps(linkproof_run *run, double *time, double *gaps, char *text, size_t size);

/* Internal steps attempted so far. */
size_t linkproof_simbody_steps(const linkproof_run *run);

void linkproof_simbody_free(linkproof_run *run);

/* Version of the Simbody library that is loaded. */
void linkproof_simbody_version(int version[3]);

/* Sizes of the four structures above, in their order. The Rust side compares them with the sizes of its structures. */
void linkproof_simbody_sizes(size_t sizes[4]);

#ifdef __cplusplus
}
#endif

#endif
