"""Proof of `gnbv sweep` on a real Slurm and with GNU parallel: the results are the local ones.

Starts munged, slurmctld and slurmd with a configuration of their own, flies a sweep of eight small
missions as a job array, requeues one task while it flies, and compares every result with that of a
local run. Needs root, Slurm, munge and GNU parallel (tools/setup --all).
"""
import csv
import os
import shutil
import socket
import subprocess
import time

import pytest
from program import until

# ports that no other Slurm of this machine has
PORT = 20000 + os.getpid() % 10000 * 4
SWEEP = '''scenarios:
  - smoke
  - {name: long, scenario: smoke, set: {planner.termination.max_iterations: 150}}
utilities: [proposed, bircher]
seeds: [1, 2]
'''
CONF = '''ClusterName=proof
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
SlurmdPort={slurmd_port}
AuthType=auth/munge
AuthInfo=socket={work}/munge/socket
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
KillWait=10
MaxArraySize=6
ReturnToService=2
StateSaveLocation={work}/state
SlurmdSpoolDir={work}/spool
SlurmctldPidFile={work}/slurmctld.pid
SlurmdPidFile={work}/slurmd.pid
SlurmctldLogFile={work}/slurmctld.log
SlurmdLogFile={work}/slurmd.log
MailProg=/bin/true
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 RealMemory=1000 State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP OverSubscribe=FORCE:1
'''


def said(*command):
    return subprocess.run(command, capture_output=True, text=True).stdout


@pytest.fixture
def slurm(tmp_path_factory, monkeypatch):
    """A Slurm of one node on this machine, whose folder it is; stopped with its jobs at the end."""
    monkeypatch.setenv('PATH', os.environ['PATH'] + ':/usr/sbin')
    for program in ('munged', 'slurmctld', 'slurmd', 'sbatch', 'scontrol', 'parallel'):
        if shutil.which(program) is None:
            pytest.skip(f'{program} is not installed')
    if os.geteuid() != 0:
        pytest.skip('has to be root')
    work = tmp_path_factory.mktemp('slurm')
    for folder in ('munge', 'state', 'spool'):
        (work / folder).mkdir()
    for folder in (work, *work.parents[:-2]):
        folder.chmod(0o755)  # munged wants no folder of a stranger's above its socket
    (work / 'munge').chmod(0o711)
    (work / 'munge/key').write_bytes(os.urandom(1024))
    (work / 'munge/key').chmod(0o600)
    if said('slurmd', '-V').split()[-1] >= '23':  # older ones have no such word, and no need
        (work / 'cgroup.conf').write_text('CgroupPlugin=disabled\n')  # a chroot has none
    (work / 'slurm.conf').write_text(CONF.format(
        host=socket.gethostname().split('.')[0], port=PORT, slurmd_port=PORT + 1, work=work))
    monkeypatch.setenv('SLURM_CONF', str(work / 'slurm.conf'))
    files = {name: work / 'munge' / name for name in ('key', 'socket', 'pid', 'seed')}
    daemons = []
    try:
        for command, what, holds in (
                (['munged', '--foreground', '--force', f'--log-file={work}/munged.log',
                  *(f'--{name}{"" if name == "socket" else "-file"}={path}'
                    for name, path in files.items())],
                 'munged answers', lambda: said('munge', '-n', '--socket', str(files['socket']))),
                (['slurmctld', '-D'], 'slurmctld answers', lambda: True),
                (['slurmd', '-D'], 'the node comes up',
                 lambda: 'idle' in said('sinfo', '-h', '-o', '%t'))):
            daemons.append(subprocess.Popen(command, stdout=subprocess.DEVNULL,
                                            stderr=(work / f'{command[0]}.err').open('w')))
            until(30, what, holds)
        yield work
    finally:
        said('scancel', '--full', '-u', 'root')  # missions would outlive the daemons
        for _ in range(50):
            if not said('squeue', '-h'):
                break
            time.sleep(0.2)
        for daemon in daemons:
            daemon.terminate()
        for daemon in daemons:
            daemon.wait()


def results(out):
    """(id, status, result_sha256) of every cell."""
    rows = csv.DictReader((out / 'results.csv').open())
    return sorted((row['id'], row['status'], row['result_sha256']) for row in rows)


@pytest.fixture
def sweep(gnbv, tmp_path):
    """sweep(*words) flies the eight missions, of which some are long enough to be stopped."""
    (tmp_path / 'sweep.yaml').write_text(SWEEP)
    return lambda *words: gnbv('sweep', 'sweep.yaml', *words)


@pytest.fixture
def local(sweep, tmp_path):
    sweep('--out', 'local', '--jobs', '2', '--threads', '1', '--quiet').check({0})
    found = results(tmp_path / 'local')
    assert len(found) == 8 and all(row[1] == 'done' and len(row[2]) == 64 for row in found)
    return found


def test_a_job_array_with_a_requeued_task(slurm, sweep, local, tmp_path):
    out = tmp_path / 'slurm'
    out.mkdir()
    job = sweep('--out', out, '--threads', '1', '--slurm', '--slurm-limit', '2', '--slurm-args',
                '--time=00:10:00').check({0}).out.strip()
    # MaxArraySize is 6, so that tasks have two cells each
    assert '--array=0-3%2' in (out / 'sweep.sbatch').read_text()
    # task 2 has the cells 4 and 5, both long: it is requeued after some views of the first
    cell = next(row[1] for row in map(str.split, sweep('--list').out.splitlines()) if row[0] == '4')
    part = out / 'cells' / f'{cell}.part'
    journal = part / 'iterations.csv.part'
    until(120, 'cell 4 is flown',
          lambda: journal.exists() and journal.read_text().count('\n') > 5)
    task = next(line.split()[1] for line in said('squeue', '-h', '-r', '-j', job, '-o', '%K %A')
                .splitlines() if line.split()[0] == '2')
    said('scontrol', 'requeue', task)
    until(60, 'the requeued task stops',
          lambda: not set('RC') & set(said('squeue', '-h', '-j', task, '-o', '%t')))
    assert not (out / 'cells' / cell).exists()
    assert not (out / 'cells' / f'{cell}.failed.json').exists()
    said('scontrol', 'update', f'jobid={task}', 'starttime=now')  # or Slurm holds it a while
    until(300, 'all cells are done', lambda: sweep('--out', out, '--status').code == 0 and
          all(row[1] == 'done' for row in results(out)))
    assert 'restart 1' in (out / 'slurm-2.log').read_text()
    assert results(out) == local


def test_gnu_parallel_over_the_index(slurm, gnbv, sweep, local, tmp_path):
    subprocess.run(['parallel', '--will-cite', '-j2', gnbv.path, 'sweep', 'sweep.yaml', '--out',
                    'parallel', '--threads', '1', '--quiet', '--index', '{}', ':::',
                    *map(str, range(8))], cwd=tmp_path, env=gnbv.environment, check=True,
                   capture_output=True)
    sweep('--out', 'parallel', '--status').check({0})
    assert results(tmp_path / 'parallel') == local
