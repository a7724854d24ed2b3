"""What is broken on purpose, over all rooms, and the tests that have to fail.

Each text stands once in its file. Tests are few and quick, since they run once for each mutant.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Mutant:
    """A change of one place of the code."""

    path: str  # below src/equipoise
    old: str
    new: str
    tests: str  # below tests, one or more

    @property
    def room(self) -> str:
        """Return the room of the package that it is in."""
        return self.path.split("/")[0]


def _of(room: str, *rows: tuple[str, str, str, str]) -> tuple[Mutant, ...]:
    return tuple(Mutant(f"{room}/{path}", old, new, tests) for path, old, new, tests in rows)


MODEL = _of("model", *(
    ("mass_properties.py", text, broken, "model/test_mass_properties.py")
    for text, broken in (
        ("offset @ offset * EYE - np.outer", "offset @ offset * EYE + np.outer"),
        ("self.inertia_P - parallel_axis", "self.inertia_P + parallel_axis"),
        ("return 0.5 * np.trace(inertia) * EYE", "return np.trace(inertia) * EYE"),
        ("body.mass > 0 and smallest", "body.mass > -1 and smallest"),
    )
), (
    "hardware.py", "return self.zero + (-1.0", "return self.zero - (-1.0",
    "hardware/boards/test_tmcl.py",
), (
    "criterion.py", "if found.high <= limit", "if found.low <= limit",
    "statistical/test_verdicts.py",
))  # fmt: skip

MATHS = _of(
    "maths",
    ("attitude.py", "2 * (x * y - w * z), 2 * (x * z + w * y)",
     "2 * (x * y + w * z), 2 * (x * z + w * y)", "maths/test_attitude.py"),
    ("attitude.py", "q = np.where(q[..., :1] < 0, -q, q)",
     "q = np.where(q[..., :1] < -2, -q, q)", "maths/test_attitude.py"),
    ("attitude.py", "angle * np.cross(up, low_side)", "angle * np.cross(low_side, up)",
     "planning/manoeuvre/test_manoeuvre_space.py::test_a_lean_lowers_the_side_that_is_named"),
    ("attitude.py", "np.sum(q[1:] * q[:-1], axis=1) < 0", "np.sum(q[1:] * q[:-1], axis=1) > 0",
     "maths/test_attitude.py"),
    ("turns.py", "w * b - i * d + j * c + k * a", "w * b + i * d + j * c + k * a",
     "maths/test_turns.py"),
    ("pseudo_inertia.py", "e * e + f * f + c * c", "f * f + c * c",
     "maths/test_pseudo_inertia.py"),
    ("levenberg_marquardt.py", "(2.0 * descent[i] - row)", "(descent[i] - row)",
     "maths/test_levenberg_marquardt.py"),
    ("scaled_solve.py", "scale[i] * normal[i, i] * scale[i] + damping",
     "scale[i] * normal[i, i] * scale[i]", "maths/test_scaled_solve.py"),
    ("whiteness.py", "chdtrc(LAGS * Q.size,", "chdtrc(LAGS,", "maths/test_whiteness.py"),
    ("gaussian_length.py", "SURE = 0.975", "SURE = 0.9", "maths/test_gaussian_length.py"),
    ("kernel_cache.py", "sha256(content(path)).digest()", 'b""', "maths/test_kernel_cache.py"),
    ("compiled.py", "ours = context.env_manager", "ours = not context.env_manager",
     "maths/test_interrupted_kernels.py"),
)  # fmt: skip

ACTUATORS = _of(
    "actuators",
    ("travel_times.py", "sd = slack / np.sqrt(12)", "sd = slack",
     "actuators/test_travel_times.py"),
    ("travel_errors.py", "effect = weight * slowness(", "effect = -weight * slowness(",
     "actuators/test_travel_errors.py"),
    ("travel_errors.py", "[0.0, 1.0, 0.0, -1.0, 0.0]", "[0.0, -1.0, 0.0, 1.0, 0.0]",
     "actuators/test_travel_errors.py"),
    ("sliding_masses.py", "m * (2 * dot * unit", "m * (dot * unit",
     "actuators/test_sliding_masses.py"),
    ("sliding_masses.py", "gain * m * (unit - ", "m * (unit - ",
     "actuators/test_sliding_masses.py"),
    ("control_moment_gyros.py", "across = np.cos(angles)[..., None] * n - np.sin",
     "across = np.cos(angles)[..., None] * n + np.sin", "actuators/test_control_moment_gyros.py"),
    ("cmg_steering.py", "return -D.T @ np.linalg.solve", "return D.T @ np.linalg.solve",
     "actuators/test_cmg_steering.py"),
    ("reaction_wheels.py", "(top - np.sign(torques) * speeds)",
     "(top + np.sign(torques) * speeds)", "actuators/test_reaction_wheels.py"),
    ("magnetorquers.py", "np.cross(dipole_of(coils, dipoles), field)",
     "np.cross(field, dipole_of(coils, dipoles))", "actuators/test_magnetorquers.py"),
    ("jets.py", "wanted - on_platform(jets, made)", "wanted + on_platform(jets, made)",
     "actuators/test_jets.py"),
    ("limiting.py", "abs(inputs[over])).min())", "abs(inputs[over])).max())",
     "actuators/test_limiting.py"),
    ("lags.py", "(behind - ahead) / (2 * reach)", "(behind - ahead) / reach",
     "actuators/test_lags.py"),
    ("stored_momentum.py", "h += rotor_momentum(cmgs, angles)",
     "h -= rotor_momentum(cmgs, angles)", "actuators/test_stored_momentum.py"),
    ("mass_allocation.py", "DEARER**tier * length", "length",
     "actuators/test_mass_allocation.py"),
)  # fmt: skip

SENSORS = _of(
    "sensors",
    ("timing.py", "- 0.5 * sensor.averaging", "- sensor.averaging", "sensors/test_timing.py"),
    ("gyro.py", "other if other < row else", "other if other <= row else", "sensors/test_gyro.py"),
    ("camera.py", "return less_cross(x, now.turn, 0.5)", "return less_cross(x, now.turn, -0.5)",
     "sensors/test_camera.py"),
)  # fmt: skip

DYNAMICS = _of(
    "dynamics",
    ("timeline.py", "if steps > MOST_STEPS:", "if steps > MOST_STEPS + 1:",
     "dynamics/test_timeline.py::test_times_too_distant_are_refused"),
    ("regressor.py", "-speed * w[i]", "speed * w[i]", "dynamics/test_regressor.py"),
    ("rigid_body.py", "-gravity * (1.0 - 2.0 * (y[1]", "gravity * (1.0 - 2.0 * (y[1]",
     "dynamics/test_propagation_laws.py"),
    ("sag_trim.py", "return -np.linalg.inv(across) @ pull", "return np.linalg.inv(across) @ pull",
     "dynamics/test_sag_trim.py"),
    ("timeline.py", "np.ceil(lengths / longest", "np.floor(lengths / longest",
     "dynamics/test_timeline.py"),
)  # fmt: skip

CONTROL = _of(
    "control",
    ("elements/attitude_pid.py", "multiply(conjugate(q), target)",
     "multiply(conjugate(target), q)", "control/elements/test_attitude_pid.py"),
    ("elements/tilt_feedback.py", "gamma, 2 * ZETA * frequency * J", "gamma, ZETA * frequency * J",
     "control/elements/test_tilt_feedback.py"),
    ("elements/slew.py", "pace.acceleration) ** 0.5", "pace.acceleration)",
     "control/elements/test_slew.py"),
    ("elements/ziegler_nichols.py", "0.45 * cycle.gain", "0.6 * cycle.gain",
     "control/elements/test_ziegler_nichols.py"),
    ("elements/sweep.py", "sweep.angle * (1 - x) * late", "sweep.angle * (1 + x) * late",
     "control/elements/test_sweep.py"),
    ("plant/settling.py", "bounds.rate * share**0.5", "bounds.rate * share",
     "control/plant/test_settling.py"),
    ("plant/actuator_limits.py", "vector if size <= most else", "vector if size >= most else",
     "control/plant/test_actuator_limits.py"),
    ("plant/pendulum.py", "cross(plant.axes.T @ v, plant.up)",
     "cross(plant.up, plant.axes.T @ v)", "control/plant/test_pendulum.py"),
)  # fmt: skip

ASSESSMENT = _of(
    "assessment",
    ("metrics/gravity_torque.py", "return -to_matrix(q)[:, 2, :]", "return to_matrix(q)[:, 2, :]",
     "assessment/metrics/test_gravity_torque.py"),
    ("metrics/motion_energy.py", "0.5 * np.sum(w * momentum, axis=1)",
     "np.sum(w * momentum, axis=1)", "assessment/metrics/test_gravity_torque.py"),
    ("metrics/residual_torque.py", "period / 2 * float(", "period * float(",
     "assessment/metrics/test_residual_torque.py"),
    ("metrics/spin_lines.py", "columns = [wave(k * psi)", "columns = [wave(psi)",
     "assessment/metrics/test_spin_lines.py"),
    ("metrics/swing_modes.py", "moment * down + steadying(", "moment * down - steadying(",
     "assessment/metrics/test_swing_modes.py"),
    ("metrics/swing_height.py", "np.vdot(shape, each.swing.shape)",
     "np.dot(shape, each.swing.shape)", "assessment/metrics/test_swing_height.py"),
    ("metrics/torque_range.py", "return weight**2 * np.einsum", "return weight * np.einsum",
     "assessment/metrics/test_torque_range.py"),
    ("record_checks/at_stop.py", 'mode="edge") > testbed', 'mode="edge") < testbed',
     "assessment/findings/test_stop_findings.py"),
    ("record_checks/clock_offset.py", "lateness(camera) - lateness(gyro)",
     "lateness(camera) + lateness(gyro)", "assessment/record_checks/test_clock_offset.py"),
    ("record_checks/frozen_rows.py", "(last - first + 1) < ALARMS", "(last - first + 1) > ALARMS",
     "assessment/record_checks/test_flagged_rows.py"),
    ("record_checks/rate_quality.py", "gaps.min(initial=np.inf)", "gaps.max(initial=0.0)",
     "assessment/findings/test_record_findings.py"),
)  # fmt: skip

ESTIMATION = _of(
    "estimation",
    ("search_budget.py", "if not self._spent():", "if True:",
     "estimation/test_search_budget.py::test_a_descent_ends_between_parts_once_its_budget_is_spent"),
    ("output_error/solution.py", "turn, normal, toward, damping, growth)",
     "turn, normal, toward, FIRST, GROWTH)", "estimation/test_search_budget.py"
     "::test_a_descent_in_parts_goes_the_way_of_one_that_is_not_stopped"),
    ("output_error/input_errors.py", "each.direct + covariance @ each.descent",
     "each.direct - covariance @ each.descent", "estimation/output_error/test_input_errors.py"),
    ("output_error/input_errors.py", "np.cross(axis, AXES).T for axis",
     "np.cross(axis, AXES) for axis", "estimation/output_error/test_input_errors.py"),
    ("motion/unresolved_rates.py", "doubtful_rates(track, testbed) > gyro.noise",
     "doubtful_rates(track, testbed) > 1e9 * gyro.noise",
     "estimation/model_selection/test_moves_between_rows.py"),
    ("events/record_model.py", "return finite_cost(found)", "return found",
     "estimation/model_selection/test_quiet_records.py::test_a_model_that_is_no_number_never_wins"),
    ("events/jump_test.py", "/ FALSE_ALARM / len(KINDS)", "/ FALSE_ALARM",
     "estimation/events/test_event_evidence.py"),
    ("events/process_noise_spectrum.py", "np.mean(sums**2, axis=0) / n",
     "np.mean(sums**2, axis=0)", "estimation/events/test_process_noise_spectrum.py"),
    ("output_error/kernels/normal_equations.py", "limit * (size - 0.5 * limit)", "limit * size",
     "estimation/output_error/kernels/test_normal_equations.py"),
    ("regression/formulations/torque.py", "(values[2:] - values[:-2]) / (2 * period)",
     "(values[2:] - values[:-2]) / period",
     "estimation/regression/formulations/test_torque.py"),
    ("regression/formulations/simplified.py", "return -(gyroscopic + products)",
     "return gyroscopic + products", "estimation/regression/formulations/test_rows.py"),
    ("regression/solvers/corrected.py", "(normal - aid.gram)", "(normal + aid.gram)",
     "estimation/regression/solvers/test_solvers.py"),
    ("regression/solvers/robust.py", "np.minimum(1.0, limit", "np.maximum(1.0, limit",
     "estimation/regression/solvers/test_solvers.py"),
    ("regression/solvers/weighted.py", "turn / np.sqrt(values / values.mean())",
     "turn * np.sqrt(values / values.mean())", "estimation/regression/solvers/test_solvers.py"),
    ("regression/error_indices.py", "/ np.sqrt(rows - unknowns)", "/ np.sqrt(rows)",
     "estimation/regression/test_error_indices.py"),
    ("information/filter_observability.py", "ahead(middle, h / 2, second)",
     "ahead(middle, h, second)", "estimation/information/test_filter_observability.py"),
    ("filters/unscented.py", "total -= L[j, k] * L[j, k]", "total += L[j, k] * L[j, k]",
     "estimation/filters/test_filter_kernels.py"),
    ("tracker/noise_level.py", "min(surprise / 3.0, BOUND) - MEAN",
     "min(surprise / 3.0, BOUND) + MEAN", "estimation/tracker/test_consistency.py"),
)  # fmt: skip

SIMULATION = _of(
    "simulation",
    ("camera_and_gyro.py", "sensor.averaging * (1.0 - NODES)", "sensor.averaging * (1.0 + NODES)",
     "simulation/test_camera_and_gyro.py"),
    ("noise_torque.py", "(1.0 - stay**2) ** 0.5", "(1.0 - stay) ** 0.5",
     "simulation/test_noise_torque.py"),
    ("events.py", "to_matrix(y[:4]).T @ np.sum(now", "to_matrix(y[:4]) @ np.sum(now",
     "simulation/test_events.py"),
    ("stop.py", "y[4 + j] -= p * a[j]", "y[4 + j] += p * a[j]", "simulation/test_stop.py"),
    ("striking.py", "p += excess(stop, y)", "p += 0.5 * excess(stop, y)",
     "simulation/test_stop.py"),
    ("free_start.py", "np.cross(com, down)", "np.cross(down, com)",
     "simulation/test_free_start.py"),
    ("sensor_errors.py", "twice = 2 * heading", "twice = heading",
     "simulation/test_sensor_errors.py"),
    ("followers.py", "step * devices.lag * (1.0 - left)", "step * devices.lag * (1.0 + left)",
     "simulation/test_devices.py"),
)  # fmt: skip

DESIGN = _of(
    "planning",
    ("manoeuvre/criterion.py", "slogdet(scaled)[1]) / len(size)", "slogdet(scaled)[1])",
     "planning/manoeuvre/test_manoeuvre_space.py"),
    ("manoeuvre/limit_check.py", "np.sqrt(rate / sensor.rate)", "np.sqrt(sensor.rate / rate)",
     "planning/manoeuvre/test_limit_check.py planning/manoeuvre/test_manoeuvre_space.py"),
    ("sizing/mass_steps.py", "shift = share * mass.resolution", "shift = mass.resolution",
     "planning/sizing/test_environment.py"),
    ("sizing/move_error.py", "half = 0.5 * np.array", "half = 1.0 * np.array",
     "planning/sizing/test_move_error.py"),
)  # fmt: skip

PROCEDURE = _of(
    "procedure",
    ("balancing/hold_verdict.py", "each.low if failing else each.high", "each.low",
     "procedure/balancing/test_hold_verdict.py"),
    ("identification/cross_checks.py", "if found.off > MOST_OFF else Why.AGREES",
     "if found.off < MOST_OFF else Why.AGREES", "procedure/identification/test_cross_checks.py"),
    ("identification/assess.py", "() if estimate.outcome.warns else answers_of",
     "() if False else answers_of", "procedure/identification/test_cross_checks.py"),
    ("steps/planned_move.py", "(np.abs(change) / speed).max()", "(np.abs(change) / speed).min()",
     "procedure/steps/test_planned_move.py"),
    ("steps/clean_record.py", "if mask.mean() > MOST:", "if mask.mean() > 2 * MOST:",
     "procedure/steps/test_clean_record.py"),
    ("steps/verify.py", "ndtr((low - com) / sd)", "ndtr((low + com) / sd)",
     "procedure/steps/test_verify.py"),
    ("steps/verify.py", "if not knowledge.estimate.outcome.usable:", "if False:",
     "procedure/steps/test_verify.py"),
    ("steps/tilt_guard.py", "rows.t >= since", "rows.t < since",
     "procedure/steps/test_tilt_guard.py"),
)  # fmt: skip

STUDY = _of(
    "study",
    ("compare_laws.py", "np.quantile(values, 0.95)", "np.quantile(values, 0.9)",
     "study/test_compare_laws.py"),
    ("compare_methods.py", "np.sqrt(np.mean(known**2))", "np.mean(known**2)",
     "study/test_compare_methods.py"),
)  # fmt: skip

IO = _of(
    "io",
    ("formats/clock_units.py", "round((t - whole) * 1e9)", "round((t + whole) * 1e9)",
     "io/mcap/test_mcap_recording.py"),
    ("recording/time_stamps.py", "np.diff(channel.t) == 0", "np.diff(channel.t) == -1",
     "io/recording/test_corrections.py"),
    ("testbed/inertia_check.py", "if low <= 0:", "if low <= -1e9:",
     "io/testbed/test_bad_input.py"),
    ("testbed/inertia_check.py", "if smallest_second_moment(inertia) <= 0:",
     "if smallest_second_moment(inertia) <= -1e9:", "io/testbed/test_bad_input.py"),
    ("formats/tlog_capture.py", "skipped, at = skipped + 1, at + 1", "break",
     "app/commands/test_captured_bytes.py"),
    ("formats/pcap_capture.py", "fragment & FRAGMENT or len(udp) < 8", "len(udp) < 8",
     "app/commands/test_captured_bytes.py"),
    ("mcap/mcap_writer.py", "append((ns, len(self._chunk)))", "append((ns, 0))",
     "io/mcap/test_readers_of_a_record.py"),
    ("mcap/mcap_summary.py", "chunk.indexes[channel] = at\n", "chunk.indexes[channel] = at + 1\n",
     "io/mcap/test_readers_of_a_record.py"),
    ("mcap/mcap_summary.py", "self._crc = zlib.crc32(data, self._crc)", "self._crc = 0",
     "io/mcap/test_readers_of_a_record.py"),
    ("mcap/foxglove_scene.py", "home = com - com_shift", "home = com + com_shift",
     "io/mcap/test_foxglove_scene.py"),
    ("mcap/foxglove_scene.py", "m.mass * m.gain * disp", "m.gain * disp",
     "io/mcap/test_foxglove_scene.py"),
    ("mcap/foxglove_scene.py", "(2 * standing.factor", "(standing.factor",
     "io/mcap/test_foxglove_scene.py"),
    ("columns/axis_permutation.py", '-1.0 if axis.startswith("-") else 1.0', "1.0",
     "io/columns/test_column_map.py"),
)  # fmt: skip

CONVERSATION = "hardware/boards/test_grbl_conversation.py"
SOAK = "hardware/boards/test_board_soak.py"
HARDWARE = _of(
    "hardware",
    ("links/frame_transform.py", "return values @ unit.alignment.T",
     "return values @ unit.alignment", "hardware/sensors/test_sensors.py"),
    ("boards/grbl/lines.py", "/ way.duration * MINUTE", "/ way.duration / MINUTE",
     "hardware/boards/test_grbl.py"),
    ("sensors/vectornav.py", "(v[3], v[0], v[1], v[2])", "(v[0], v[1], v[2], v[3])",
     "hardware/sensors/test_sensors.py"),
    ("bench/interlocks.py", "if since > limits.stale:", "if since > 10 * limits.stale:",
     "hardware/bench/test_interlocks.py"),
    ("bench/interlocks.py", "if rate <= limits.rate:", "if rate <= 2 * limits.rate:",
     "hardware/bench/test_interlocks.py"),
    ("transport/line_splitter.py", "if len(self.rest) > LONGEST:",
     "if len(self.rest) > 1000 * LONGEST:", "hardware/transport/test_line_splitter.py"),
    # The conversation of boards
    ("transport/command_queue.py", "return None if self._void else done", "return done",
     "hardware/boards/test_tmcl.py"),
    ("transport/command_queue.py", "if self.pending is not None or not self._waiting:",
     "if not self._waiting:", "hardware/boards/test_tmcl.py"),
    ("transport/attended_time.py", "min(max(t - self._turn, 0.0), LISTENED)", "t - self._turn",
     CONVERSATION),
    ("transport/attended_time.py", "min(t, self._turn + LISTENED)", "t", CONVERSATION),
    ("boards/grbl/talk.py", "elif self.awaiting and not (isinstance", "elif not (isinstance",
     CONVERSATION),
    ("boards/grbl/talk.py", "self.queried, self._queried_at = self._open.popleft()",
     "self.queried, self._queried_at = self._open.pop()", CONVERSATION),
    ("boards/grbl/halt.py", "Wish.WAIT if slowing(before, status.feed) else Wish.CANCEL",
     "Wish.CANCEL", CONVERSATION),
    ("boards/grbl/halt.py", "return self._anew(Wish.HOLD)", "return self._anew(Wish.CANCEL)",
     CONVERSATION),
    ("boards/grbl/halt.py", "return Wish.STANDS if synced else Wish.SYNC", "return Wish.STANDS",
     CONVERSATION),
    ("boards/grbl/driver.py", "if refused is Step.LEG and code.number == IDLE_ERROR:",
     "if refused is Step.LEG and code.number == -1:", CONVERSATION),
    ("boards/grbl/suspension.py", "return talk.queried > self._first_idle + LONGER", "return False",
     CONVERSATION),
    ("boards/grbl/driver.py", "if self._talk.queried <= self._changed or", "if", CONVERSATION),
    ("boards/grbl/lateness.py", "if talk.question_waited > SILENCE and not talk.homing:",
     "if talk.question_waited > SILENCE:", CONVERSATION),
    ("boards/grbl/lateness.py", "talk.queue.overdue and (talk.homing or talk.reported_since_due)",
     "talk.queue.overdue", SOAK),
    ("boards/grbl/driver.py", "if step is Step.HOME:", "if step is None:", CONVERSATION),
    ("boards/grbl/place.py", "if standing and found not in (self.at, self._odd):", "if False:",
     CONVERSATION),
    ("boards/tmcl/driver.py", "if at != self._at or self._commanded:", "if at != self._at:", SOAK),
    ("boards/tmcl/driver.py", "shifted=self._calls > 0", "shifted=False",
     "hardware/boards/test_tmcl.py"),
    ("transport/requests.py", "request.times and now - request.since > PATIENCE", "False",
     "hardware/transport/test_requests.py"),
    ("transport/requests.py", "self._following[name] = t + self._again",
     "self._following[name] = float('inf')", "hardware/transport/test_requests.py"),
    ("sensors/mavlink.py", "self._void, self._sent = max(self._sent - 1, 0), 0",
     "self._void, self._sent = 0, 0", "hardware/sensors/test_mavlink.py"),
    ("links/sensor_link.py", "self._came |= {row.channel: self._clock.now for row in rows}",
     "self._came |= dict.fromkeys(self._came, self._clock.now) if rows else {}",
     "hardware/links/test_sensor_link.py"),
    ("links/clock_sync.py", "late <= LATE + waited", "late <= LATE",
     "hardware/links/test_sensor_link.py"),
    ("links/captured_rows.py", "self._now += broken * (self._step or 0.0)", "pass",
     "app/commands/test_captured_bytes.py"),
    ("links/captured_rows.py", "if stamp < clock.last:", "if stamp < 0 * clock.last:",
     "app/commands/test_captured_bytes.py"),
    ("bench/atomic_message.py", "for number in before:", "for number in ():",
     "hardware/bench/test_atomic_message.py"),
    ("camera/board_errors.py", "SCALE_SD = 0.003", "SCALE_SD = 0.00003",
     "hardware/camera/test_board_scale.py::test_a_print_of_another_scale_errs_as_stated"),
    ("camera/board_errors.py", "np.cross([0.0, 0.0, 1.0], off)", "np.cross([0.0, 0.0, -1.0], off)",
     "hardware/camera/test_boards.py::test_errors_of_a_board_move_its_borders_as_said"),
    ("camera/layouts.py", "rotation=math.pi", "rotation=0.0",
     "hardware/camera/test_boards.py::test_an_aprilgrid_as_kalibr_prints_it_is_found_with_its_axes"),
    ("camera/borders.py", "(by_point @ turn)[:, None]", "-(by_point @ turn)[:, None]",
     "hardware/camera/test_board_scale.py::test_a_print_of_another_scale_errs_as_stated"),
)  # fmt: skip

APP = _of(
    "app",
    ("console/stop_request.py", "if self._put_off or (unfit(frame) and",
     "if self._put_off or (False and", "app/console/test_stop_request.py"),
    ("console/stop_request.py", "echo = number == HANG_UP and", "echo = False and",
     "app/console/test_stop_request.py"),
    ("dashboard/server/gate.py", 'any(origin == f"http://{host}"',
     'any(origin.startswith(f"http://{host}")', "app/dashboard/server/test_gate.py"),
    ("dashboard/server/authorisation.py", "self._commander not in (None, page)", "False",
     "app/dashboard/server/test_gate.py"),
    ("dashboard/protocol/data_folder.py", "not path.is_relative_to(folder.resolve()) or", "",
     "app/dashboard/server/test_gate.py"),
    ("text/numbers.py", "return DIGITS - 1 - math.floor", "return DIGITS - math.floor",
     "app/text/test_numbers.py"),
    ("text/sparkline.py", "max(columns[k] or 0.0, value)", "min(columns[k] or 0.0, value)",
     "app/text/test_sparkline.py"),
    ("cli.py", "WRONG_USE = 2", "WRONG_USE = 1", "app/test_exit_codes.py"),
)  # fmt: skip

MUTANTS = (
    *MODEL, *MATHS, *ACTUATORS, *SENSORS, *DYNAMICS, *CONTROL, *ASSESSMENT, *ESTIMATION,
    *SIMULATION, *DESIGN, *PROCEDURE, *STUDY, *IO, *HARDWARE, *APP,
)  # fmt: skip
