"""Hostile programs: `hostile.py BEHAVIOUR [ANSWER]`. Each does the handshake and answers every problem with ANSWER
(a JSON object), except for what BEHAVIOUR changes."""
import json
import os
import signal
import subprocess
import sys
import time

SETTINGS = []  # ids of the settings received
ANSWER = json.loads(sys.argv[2]) if len(sys.argv) > 2 else {"number": 1}


def write(text):
    sys.stdout.write(text)
    sys.stdout.flush()


def say(**message):
    write(json.dumps(message) + "\n")


def answer_to(problem, **instead):
    number = {"number": problem["number"]} if "number" in problem else {}
    return {"type": "answer", "id": problem["id"], "answer": ANSWER} | number | instead


def answer(problem, **instead):
    say(**answer_to(problem, **instead))


def tells_its_settings(problem):
    answer(problem, answer={"number": len(SETTINGS), "ids": " ".join(SETTINGS + [problem["id"]])})


def crashes(problem):
    print("about to fall\n\n", file=sys.stderr, flush=True)
    os.kill(os.getpid(), signal.SIGSEGV)


def crashes_at_every_second_problem(problem, asked=[0]):
    asked[0] += 1
    crashes(problem) if asked[0] == 2 else answer(problem)


def exits(problem):
    write('{"type": "ans')
    sys.exit(3)


def hangs(problem):
    time.sleep(1000)


def prints_garbage(problem):
    write("loading model \x1b[1m100%\x1b[0m\n")


def answers_minus_infinity(problem):
    write('{"type": "answer", "id": "%s", "answer": {"number": [1, -Infinity]}}\n' % problem["id"])


def answers_nan(problem):
    write('{"type": "answer", "id": "%s", "answer": {"number": NaN}}\n' % problem["id"])


def answers_a_key_twice(problem):
    write('{"type": "answer", "id": "%s", "answer": {"number": 1, "number": 2}}\n' % problem["id"])


def answers_beyond_doubles(problem):
    write('{"type": "answer", "id": "%s", "answer": {"number": 1e999}}\n' % problem["id"])


def answers_deeply(problem):
    write("[" * 1000000 + "\n")


def answers_bytes(problem):
    sys.stdout.buffer.write(b'{"type": "answer", "id": "\xff\xfe"}\n')
    sys.stdout.flush()


def answers_behind_a_zero_byte(problem):
    line = json.dumps({"type": "answer", "id": problem["id"], "answer": ANSWER})
    write(line + "\0 and whatever else\n")


def answers_without_end(problem):
    while True:
        write("x" * 65536)


def answers_twice(problem):
    line = json.dumps({"type": "answer", "id": problem["id"], "answer": ANSWER}) + "\n"
    write(line + line)


def chats_after_its_answer(problem):
    answer(problem)
    end = time.process_time() + 0.005
    while time.process_time() < end:
        pass
    write("done\n")


def begins_a_line_after_its_answer(problem):
    answer(problem)
    write("done ")


def ends_after_its_answer(problem):
    answer(problem)
    sys.exit(0)


def answers_again_after_the_next_question(problem, asked=[]):
    """Answers each question twice. The second answer differs, and comes after the next question."""
    for question in asked[-1:]:
        answer(question, answer={"number": 2})
    answer(problem)
    asked.append(problem)


def repeats_itself_without_end(problem, asked=[]):
    asked.append(problem["id"])
    while len(asked) > 1:
        time.sleep(0.001)
        say(type="answer", id=asked[0], answer=ANSWER)
    answer(problem)


def answers_another_question(problem):
    answer(problem, id="another")


def answers_a_list(problem):
    answer(problem, answer=[1, 2])


def answers_late(problem):
    time.sleep(0.2)
    answer(problem)


def answers_large(problem):
    answer(problem, answer={"number": "x" * 5_000_000})


def eats_memory(problem):
    eaten = []
    while True:
        eaten.append(bytearray(b"x" * 10_000_000))


def lets_a_child_eat_memory(problem):
    """Starts a child in its own session, whose parent ends."""
    script = "eaten = bytearray(b'x' * 150_000_000); import time; time.sleep(1000)"
    subprocess.run(["sh", "-c", 'setsid python3 -c "$0" </dev/null >/dev/null & exit', script])
    hangs(problem)


def leaves_a_child_at_its_output(problem):
    subprocess.Popen(["sleep", "1000"])
    sys.exit(5)


def closes_its_output(problem):
    os.close(1)
    time.sleep(1000)


def moves_its_output(problem):
    """Moves the output to another descriptor, and answers when this has been sampled several times."""
    moved = os.dup(1)
    os.close(1)
    time.sleep(0.2)
    os.write(moved, (json.dumps(answer_to(problem)) + "\n").encode())


def floods_its_standard_error(problem, asked=[0]):
    asked[0] += 1
    for _ in range(100):
        sys.stderr.write(("x" * 99 + "\n") * 1000)
    print("the last line", file=sys.stderr, flush=True)
    crashes(problem) if asked[0] == 2 else answer(problem)


def counts_its_problems(problem, asked=[0]):
    asked[0] += 1
    answer(problem, answer=ANSWER | {"iterations": asked[0]})


def remembers_the_first_problem(problem, first=[]):
    first.append(problem["problem"]["start_angles_deg"])
    answer(problem, answer={"angles_deg": first[0]})


def refuses_what_it_does_not_know(problem):
    prints_garbage(problem) if "of_a_later_version" in problem["problem"] else answer(problem)


def at_step(number, then):
    """Behaves well until step `number` of a session."""
    def step(message):
        if message["type"] == "step" and message["number"] == number:
            then(message)
        else:
            answer(message)
    return step


dies_in_a_session = at_step(2, lambda step: sys.exit("out of luck"))
hangs_in_a_session = at_step(2, hangs)
prints_garbage_in_a_session = at_step(2, prints_garbage)
answers_a_session_twice = at_step(2, lambda step: (answer(step), answer(step)))
answers_another_step = at_step(2, lambda step: answer(step, number=7))
answers_the_next_step_as_well = at_step(1, lambda step: write("".join(
    json.dumps(answer_to(step, number=number)) + "\n" for number in [1, 2])))
gives_up_in_a_session = at_step(2, lambda step: gives_up(step))


def says_no_number(message):
    say(type="answer", id=message["id"], answer=ANSWER)


def gives_up(problem):
    say(type="no_answer", id=problem["id"], reason="no way\nout")


def works_a_while(problem):
    """Works until the kernel has counted 0.05 s more of this process's processor time."""
    end = sum(os.times()[:2]) + 0.05
    while sum(os.times()[:2]) < end:
        pass
    answer(problem)


def is_good(problem):
    answer(problem)


def main(behaviour):
    if behaviour == "never_reads":
        time.sleep(1000)
    for line in sys.stdin:
        message = json.loads(line)
        if message["type"] == "hello":
            if behaviour == "dies_in_the_handshake":
                with open(sys.argv[3], "a") as log:
                    log.write("started\n")
                sys.exit("no licence found")
            protocol = 2 if behaviour == "speaks_another_protocol" else 1
            say(type="hello", protocol=protocol, name="hostile", version="1.0")
        elif message["type"] == "setting":
            SETTINGS.append(message["id"])
            if behaviour == "dies_at_a_setting" and message["setting"]["name"] == "fatal":
                sys.exit(7)
            say(type="ready")
            if behaviour == "chats_after_its_setting":
                write("done\n")
        elif message["type"] == "begin" and behaviour != "answers_the_beginning":
            say(type="ready")
        else:
            globals().get(behaviour, is_good)(message)


main(sys.argv[1])
if sys.argv[1] == "stays_after_the_end":
    time.sleep(1000)
