/* The C side of linkproof-simbody: a planar linkage as a Simbody system. SI units throughout; angles in rad, counter-clockwise.
 * No exception leaves these functions. src/ffi.rs repeats every declaration of this file. */
#ifndef LINKPROOF_SIMBODY_SHIM_H
#define LINKPROOF_SIMBODY_SHIM_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A body and the mobilizer that hangs it on its parent. Bodies are numbered from 1, the ground is 0; a parent has a smaller
 * number than its child. Places and axes are given in the frame of the body they are on. */
typedef struct linkproof_body {
    size_t parent;
    int slides;            /* 0: pin, its coordinate is the angle of the child in its parent; else: slider along the axes. */
    double on_parent[2];   /* Place of the joint on the parent, on the child. */
    double on_child[2];
    double axis_parent[2]; /* Unit vectors of a slider's axis; its coordinate is the way along it from the parent's place. */
    double axis_child[2];
    double mass;
    double centre[2];
    double inertia;        /* About the mass centre. */
    double extra_mass;     /* Carried besides, at the same centre; reactions are those without it. */
    double extra_inertia;
    double resistance;     /* Moment against the rotation, nothing at rest. */
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

/* What became of a body, in world axes. Force and moment are zero where reactions were not asked for. */
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
    double moment;       /* The same, about the joint's place on the body; the drive's moment is part of it. */
    double drive;        /* Generalised force that the prescribed motion takes. */
} linkproof_body_state;

typedef struct linkproof_loop_state {
    double force[2]; /* Of the first body on the second. */
    double gap;      /* Distance of the two places. */
} linkproof_loop_state;

typedef struct linkproof_run linkproof_run;

/* What acts on the bodies besides gravity while time goes on: given positions and velocities of all bodies (accelerations and forces are zero), writes for every body
 * the force at its mass centre (N, world axes) and the moment about it (N m). Must not throw. */
typedef void (*linkproof_act)(void *user, const linkproof_body_state *bodies, double *loads);

/* Texts are cut to `size` bytes, the final zero included. All of these return 0, or else they write a text. */

/* `act` may be null: then nothing else acts. It is called with `user` as long as the run lives. Builds the system and assembles it to `tolerance`: no constraint error is larger (m), nor any of their rates times `time_scale`
 * (s). `accuracy` is that of the integrator. */
int linkproof_simbody_new(const linkproof_body *bodies, size_t body_count, const linkproof_loop *loops, size_t loop_count,
                          const double gravity[2], double accuracy, double tolerance, double time_scale,
                          linkproof_act act, void *user, linkproof_run **run, char *text, size_t size);

/* Integrates on to `time` (not before the time reached), in at most `steps` internal steps. */
int linkproof_simbody_advance(linkproof_run *run, double time, size_t steps, char *text, size_t size);

/* Reads the state reached; with `reactions`, forces too. As many entries as there are bodies and loops. */
int linkproof_simbody_read(linkproof_run *run, int reactions, linkproof_body_state *bodies, linkproof_loop_state *loops,
                           char *text, size_t size);

/* Loads on every body that the next readings count: three numbers each, the force at the mass centre (N, world axes) and the moment about it (N m). They do
 * not move anything: every freedom is prescribed. None at first. */
void linkproof_simbody_load(linkproof_run *run, const double *loads);

/* Time that the integrator has reached, also after a failure, and the gap of every loop there. */
int linkproof_simbody_gaps(linkproof_run *run, double *time, double *gaps, char *text, size_t size);

/* Internal steps attempted so far. */
size_t linkproof_simbody_steps(const linkproof_run *run);

void linkproof_simbody_free(linkproof_run *run);

/* Version of the Simbody library that is loaded. */
void linkproof_simbody_version(int version[3]);

/* Sizes of the four structures above, in their order: the Rust side checks its own. */
void linkproof_simbody_sizes(size_t sizes[4]);

#ifdef __cplusplus
}
#endif

#endif
