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
    int slides;            /* 0: pin, its coordinate is the angle of the child relative to its parent; else: slider. */
    double on_parent[2];   /* Position of the joint on the parent, then on the child. */
    double on_child[2];
    double axis_parent[2]; /* Unit vectors of a slider's axis; its coordinate is the distance along it from the parent's point. */
    double axis_child[2];
    double mass;
    double centre[2];
    double inertia;        /* About the mass centre. */
    double extra_mass;     /* Additional mass at the same centre; reactions do not contain it. */
    double extra_inertia;
    double resistance;     /* Moment against the rotation, zero at rest. */
    double coordinate;     /* Of the mobilizer at time 0. */
    int driven;            /* Whether the coordinate is prescribed: coordinate + rate * time. */
    double rate;           /* Of the coordinate: prescribed, or at time 0. */
} linkproof_body;

/* A revolute joint between two bodies of the tree. */
typedef struct linkproof_loop {
    size_t first;
    size_t second;
    double on_first[2];
    double on_second[2];
} linkproof_loop;

/* State of a body, in world axes. Force and moment are zero if reactions were not requested. */
typedef struct linkproof_body_state {
    double coordinate;
    double rate;         /* Of the coordinate. */
    double origin[2];
    double direction[2]; /* Unit vector of its x axis. */
    double velocity[2];
    double omega;
    double acceleration[2];
    double alpha;
    double force[2];     /* Of the mobilizer on the body. */
    double moment;       /* The same, about the joint's point on the body; it includes the driving moment. */
    double drive;        /* Generalised force of the prescribed motion. */
} linkproof_body_state;

typedef struct linkproof_loop_state {
    double force[2]; /* Of the first body on the second. */
    double gap;      /* Distance between the two points. */
} linkproof_loop_state;

typedef struct linkproof_run linkproof_run;

/* Computes the loads on the bodies during the run, without gravity.
 * The input has positions and velocities of all bodies; accelerations and forces are zero.
 * The output is, for every body, the force at its mass centre (N, world axes) and the moment about it (N m).
 * The function must not throw. */
typedef void (*linkproof_act)(void *user, const linkproof_body_state *bodies, double *loads);

/* Texts are cut to `size` bytes, including the final zero. All these functions return 0, or 1 with a text on failure. */

/* Builds the system and assembles it to `tolerance` (m).
 * No constraint error exceeds `tolerance`, and neither does its rate times `time_scale` (s).
 * `accuracy` is that of the integrator.
 * If `act` is null, gravity is the only load. `act` is called with `user` as long as the run lives. */
int linkproof_simbody_new(const linkproof_body *bodies, size_t body_count, const linkproof_loop *loops, size_t loop_count,
                          const double gravity[2], double accuracy, double tolerance, double time_scale,
                          linkproof_act act, void *user, linkproof_run **run, char *text, size_t size);

/* Integrates to `time` (not before the time reached), in at most `steps` internal steps. */
int linkproof_simbody_advance(linkproof_run *run, double time, size_t steps, char *text, size_t size);

/* Reads the present state; with `reactions`, also forces.
 * The arrays have as many entries as there are bodies and loops. */
int linkproof_simbody_read(linkproof_run *run, int reactions, linkproof_body_state *bodies, linkproof_loop_state *loops,
                           char *text, size_t size);

/* Sets the loads on every body that the next readings include.
 * They are three numbers each: the force at the mass centre (N, world axes) and the moment about it (N m).
 * They do not change the motion, because every degree of freedom is prescribed. All are zero at first. */
void linkproof_simbody_load(linkproof_run *run, const double *loads);

/* Time that the integrator has reached, also after a failure, and the gap of every loop there. */
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
