import sys; sys.path.insert(0,"/tmp/h-modes-exp")
from exp import *
for seed in (2,8,11):
    t=time.process_time()
    rng=np.random.default_rng([seed,41]); pl,part=V.with_part(rng,"pendulum"); t1=time.process_time()
    run,mode=V.simulated("pendulum",seed); t2=time.process_time()
    n=np.array([oracle.matrix(q).T@F.DOWN for q in run.q[::500]])
    c=part.mass*np.linalg.norm(part.arm)/pl.mass
    print(seed,"cpu",round(t1-t,2),round(t2-t1,2),"tilt deg max",np.degrees(np.arccos(-n[:,2])).max().round(2),"c um",round(c*1e6,2),"m",part.mass,"arm",part.arm[2],"sagtot um",1e6*part.mass*9.81/((mode.frequency*6.283)**2*pl.mass),"kshare",part.stiffness/(part.stiffness+part.mass*9.81*np.linalg.norm(part.arm)),"a",part.axis.round(3), "rate max deg/s",np.degrees(np.abs(run.rate).max()))
